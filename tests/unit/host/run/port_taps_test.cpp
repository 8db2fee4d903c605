// SPDX-License-Identifier: GPL-3.0-or-later
#include "orca/host/port_taps.hpp"

#include <catch2/catch.hpp>
#include <chrono>
#include <future>
#include <vector>

#include "numbered_command.hpp"
#include "orca/idl/pool.hpp"

using namespace orca;
using namespace orca::host;
using namespace orca::test;

namespace {

// MotionCommands that are measured while another component passes an object, for which a second is more than enough.
struct Measured {
  static inline PortTaps* taps = nullptr;
  static inline int count = 0;
  static inline bool lets_others_pass = false;
  static inline std::vector<std::future<void>> others;

  static std::size_t write(const void* /*object*/, std::span<std::byte> /*to*/) {
    ++count;
    others.push_back(std::async(std::launch::async,
                                [] { taps->pass(Flow::pushed, "avoid", "out", numbered_command(1)); }));
    lets_others_pass = others.back().wait_for(std::chrono::seconds(1)) == std::future_status::ready;
    return 10;
  }

  static const ObjectType& type();
};

const ObjectType& Measured::type() {
  static const ObjectType& model = object_type<idl::MotionCommand>();
  struct Own {
    Own()
        : type{model.name,      model.layout,      model.layout_hash, model.parent, model.size,
               model.align,     model.construct,   model.destroy,     model.assign, model.equal,
               model.header,    model.stamp,       model.dump,        model.fields, Measured::write,
               model.serialize, model.deserialize, model.bulk,        pool},
          pool(type) {}
    const ObjectType type;
    detail::Pool pool;
  };
  static auto* const own = new Own;  // views may outlive all else
  return own->type;
}

}  // namespace

TEST_CASE("an object is measured once for all taps at its port, while those of other components pass",
          "[host][taps]") {
  const auto executive = std::move(make_executive({ClockKind::virtual_time, Backend::fiber})).value();
  PortTaps taps(*executive);
  Measured::taps = &taps;
  Measured::count = 0;
  const PortTap::Bounds bounds{.objects = 10, .bytes = 100};
  const auto first = taps.open({{"goto", "out", Flow::pushed}}, bounds);
  const auto second = taps.open({{"goto", "out", Flow::pushed}, {"goto", "in", Flow::delivered}}, bounds);
  const auto elsewhere = taps.open({{"base", "out", Flow::pushed}}, bounds);
  taps.pass(Flow::pushed, "goto", "out", make_object(Measured::type()).seal());
  Measured::others.clear();  // waits for them
  CHECK(Measured::count == 1);
  CHECK(Measured::lets_others_pass);
  CHECK(first->take().size() == 1);
  CHECK(second->take().size() == 1);
  CHECK(elsewhere->take().empty());
}

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
