// SPDX-License-Identifier: GPL-3.0-or-later
#include "orca/host/port_taps.hpp"

#include <catch2/catch.hpp>

#include "numbered_command.hpp"

using namespace orca;
using namespace orca::host;
using namespace orca::test;

namespace {

PortContract contract_of_port(const std::string& name, Pattern pattern, Role role) {
  PortContract contract;
  contract.name = name;
  contract.pattern = pattern;
  contract.role = role;
  return contract;
}

}  // namespace

TEST_CASE("a tap sees what passes its port at the moment that fits the port, and nothing else",
          "[host][taps]") {
  const auto executive = std::move(make_executive({ClockKind::virtual_time, Backend::fiber})).value();
  PortTaps taps(*executive);
  taps.pass(Flow::pushed, "goto", "out", numbered_command(1));  // nobody looks
  const auto out = taps.open("goto", contract_of_port("out", Pattern::push, Role::server));
  const auto in = taps.open("goto", contract_of_port("in", Pattern::push, Role::proxy));
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
  auto tap = taps.open("goto", contract_of_port("order", Pattern::send, Role::proxy));
  const std::size_t live = pool_statistics(object_type<idl::MotionCommand>()).live;
  for (std::uint64_t i = 0; i < PortTap::kMost + 10; ++i)
    taps.pass(Flow::requested, "goto", "order", numbered_command(i));
  CHECK(tap->lost() == 10);
  CHECK(tap->take().size() == PortTap::kMost);
  taps.pass(Flow::requested, "goto", "order", numbered_command(1));
  tap.reset();
  taps.pass(Flow::requested, "goto", "order", numbered_command(2));
  CHECK(pool_statistics(object_type<idl::MotionCommand>()).live == live);
}
