// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <catch2/catch.hpp>

#include <cmath>
#include <string>
#include <vector>

#include "bad_line.hpp"
#include "deployer.hpp"
#include "device_on_desk.hpp"
#include "virtual_desk.hpp"

namespace orca::test {

/// A base on a desk, with a line that a test can spoil.
/// @tparam Desk  VirtualDevice or DeviceOnDesk.
template <template <class, class> class Desk, class Firmware>
struct BaseOn : Desk<BadLine<Firmware>, PlainBody> {
  using Line = BadLine<Firmware>;
  using Desk<Line, PlainBody>::Desk;

  /// Looks at its firmware, or changes it.
  template <class Look>
  auto look(Look at) {
    return this->with([&](Line& line, PlainBody&) { return at(line.device()); });
  }
  /// Returns what a function of its firmware does.
  template <class Result>
  auto ask(Result (Firmware::*what)() const) {
    return look([what](Firmware& firmware) { return (firmware.*what)(); });
  }
  bool has_power() { return ask(&Firmware::has_power); }
  int watchdog_stops() { return ask(&Firmware::watchdog_stops); }
  /// The same for its line and its body.
  template <class Look>
  auto line(Look at) {
    return this->with([&](Line& line, PlainBody&) { return at(line); });
  }
  template <class Look>
  auto body(Look at) {
    return this->with([&](Line&, PlainBody& body) { return at(body); });
  }
  Twist2 velocity() {
    return body([](PlainBody& body) { return body.velocity(); });
  }
  Pose2 pose() {
    return body([](PlainBody& body) { return body.odometry(); });
  }
  bool moves() { return velocity().forward > 0.1; }
  bool stands() { return velocity() == Twist2{}; }
  void spoil(const std::function<void(std::vector<std::uint8_t>&)>& change) {
    line([&](Line& line) { line.spoil(change); });
  }

  /// Checks that it has come to the last of the two goals of its graph.
  void check_at_goal(const Run& run) {
    INFO(run.err);
    CHECK(run.exit_code() == 0);
    REQUIRE(run.arrivals().size() == 2);
    CHECK(std::hypot(pose().x - run.arrivals()[1].x, pose().y - run.arrivals()[1].y) < 0.1);
    CHECK(stands());
  }
};

/// A base in virtual time.
template <class Firmware>
struct VirtualBase : BaseOn<VirtualDevice, Firmware> {
  using BaseOn<VirtualDevice, Firmware>::BaseOn;

  void set_off() {
    REQUIRE(bench().until([this] { return this->moves(); }));
  }
  /// Switches it off and on.
  void reset() {
    this->line([this](auto& line) { line.reset(this->now()); });
  }
  /// Checks that it comes to a stand, and stands for a second, whatever Goto wishes.
  void check_stays() {
    REQUIRE(bench().until([this] { return this->stands(); }));
    const Pose2 there = this->pose();
    bench().sleep(1s);
    CHECK(this->pose() == there);
  }
  /// Checks that it waits for an operator, who lets it go.
  void check_waits_for_operator() {
    check_stays();
    CHECK(bench().seat().let_go());
    CHECK(bench().until([this] { return this->moves(); }));
  }
};

/// Returns the words for a graph of these tests whose hardware hangs on that line.
inline Words on_line(const std::string& graph, const std::string& device, const Words& more = {}) {
  return Words{system_graph(graph), "--set", "device=" + device} + more;
}
/// Those for a goal that is not reached.
inline Words far_goal(const Words& more = {}) { return Words{"--set", "goals=far: 30 0"} + more; }

/// Kills a whole system that drives a base in real time, and waits until the base does as it should then.
/// @return the time from the one to the other.
template <class Base>
Duration kill_while_it_drives(Base& base, const Words& words, const std::function<bool()>& comes_true) {
  Subprocess program(deployer(words + far_goal({"--in-process"})));
  REQUIRE(eventually([&] { return base.moves(); }));
  const TimePoint killed = steady_now();
  program.send(SIGKILL);
  CHECK(eventually(comes_true));
  return steady_now() - killed;
}

}  // namespace orca::test
