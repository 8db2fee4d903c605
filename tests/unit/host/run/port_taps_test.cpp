// SPDX-License-Identifier: GPL-3.0-or-later
#include "orca/host/port_taps.hpp"

#include <catch2/catch.hpp>

#include "numbered_command.hpp"

using namespace orca;
using namespace orca::host;
using namespace orca::test;

TEST_CASE("a tap sees what passes its port at the moment that fits the port, and nothing else",
          "[host][taps]") {
  const auto executive = std::move(make_executive({ClockKind::virtual_time, Backend::fiber})).value();
  PortTaps taps(*executive);
  taps.pass(Flow::pushed, "goto", "out", numbered_command(1));  // nobody looks
  const auto out = taps.open({{"goto", "out", Flow::pushed}});
  const auto in = taps.open({{"goto", "in", Flow::delivered}});
  taps.pass(Flow::pushed, "goto", "out", numbered_command(2));
  taps.pass(Flow::delivered, "goto", "out", numbered_command(3));
  taps.pass(Flow::pushed, "avoid", "out", numbered_command(4));
  taps.pass(Flow::delivered, "goto", "in", numbered_command(5));
  const auto passed = out->take();
  REQUIRE(passed.size() == 1);
  CHECK(passed[0].object.header().seq() == 2);
  CHECK(passed[0].time == executive->now());
  CHECK(in->take().size() == 1);
  CHECK(out->take().empty());
}

TEST_CASE("a tap that nobody empties loses objects and counts them, and one that is closed keeps none alive",
          "[host][taps]") {
  const auto executive = std::move(make_executive({ClockKind::virtual_time, Backend::fiber})).value();
  PortTaps taps(*executive);
  auto tap = taps.open({{"goto", "order", Flow::requested}});
  const std::size_t live = pool_statistics(object_type<idl::MotionCommand>()).live;
  for (std::uint64_t i = 0; i < PortTap::Bounds{}.objects + 10; ++i)
    taps.pass(Flow::requested, "goto", "order", numbered_command(i));
  CHECK(tap->lost() == std::vector<std::uint64_t>{10});
  CHECK(tap->take().size() == PortTap::Bounds{}.objects);
  taps.pass(Flow::requested, "goto", "order", numbered_command(1));
  tap.reset();
  taps.pass(Flow::requested, "goto", "order", numbered_command(2));
  CHECK(pool_statistics(object_type<idl::MotionCommand>()).live == live);
}

TEST_CASE("a tap of several ports says where each object has passed, and counts what it loses by port",
          "[host][taps]") {
  const auto executive = std::move(make_executive({ClockKind::virtual_time, Backend::fiber})).value();
  PortTaps taps(*executive);
  const auto tap =
      taps.open({{"goto", "out", Flow::pushed}, {"goto", "in", Flow::delivered}}, {.objects = 2});
  taps.pass(Flow::delivered, "goto", "in", numbered_command(1));
  taps.pass(Flow::pushed, "goto", "out", numbered_command(2));
  taps.pass(Flow::delivered, "goto", "in", numbered_command(3));
  const auto passed = tap->take();
  REQUIRE(passed.size() == 2);
  CHECK(passed[0].place == 1);
  CHECK(passed[1].place == 0);
  CHECK(tap->lost() == std::vector<std::uint64_t>{0, 1});
}

TEST_CASE(
    "a tap bounded in bytes takes objects up to its bound, and one that is larger if nothing else waits",
    "[host][taps]") {
  const auto executive = std::move(make_executive({ClockKind::virtual_time, Backend::fiber})).value();
  PortTaps taps(*executive);
  const ObjectRef command = numbered_command(1);
  const std::size_t size = command.type().write(command.get(), {});
  const auto tap = taps.open({{"goto", "out", Flow::pushed}}, {.objects = 100, .bytes = 3 * size});
  for (int i = 0; i < 5; ++i) taps.pass(Flow::pushed, "goto", "out", command);
  CHECK(tap->take().size() == 3);
  CHECK(tap->lost() == std::vector<std::uint64_t>{2});
  const auto narrow = taps.open({{"goto", "out", Flow::pushed}}, {.objects = 100, .bytes = 1});
  taps.pass(Flow::pushed, "goto", "out", command);
  CHECK(narrow->take().size() == 1);
}
