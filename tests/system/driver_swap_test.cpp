// SPDX-License-Identifier: GPL-3.0-or-later
// orcactl swap of hardware: the driver of a base is exchanged in real time, on the robot's way to a goal.
#include <catch2/catch.hpp>

#include <thread>

#include "deployer.hpp"
#include "temp_folder.hpp"

using namespace orca::test;
using namespace std::chrono_literals;
using Catch::Contains;

namespace {

std::string next_version(const std::string& name) {
  return std::string(ORCA_BINARY_DIR "/tests/next_plugins/") + name + ".so";
}

// A cart that stands where its driver has left it, whichever drives it next, and is sent some metres ahead at 0.5 m/s.
std::string graph(const std::string& file, const std::string& metres) {
  return "<graph name=\"driver_swap\" version=\"1\" ends=\"command\" plugins=\"" ORCA_BINARY_DIR
         "/tests/host_plugins\">\n"
         "  <process name=\"body\"/>\n"
         "  <hardware name=\"cart\" type=\"test.Cart\"><param name=\"file\" value=\"" +
         file +
         "\"/></hardware>\n"
         "  <component name=\"base\" type=\"orca.RobotBaseServer\" hardware=\"cart\" process=\"body\"/>\n"
         "  <component name=\"goto\" type=\"orca.Goto\"/>\n"
         "  <component name=\"fuser\" type=\"orca.MotionCommandFuser\"/>\n"
         "  <component name=\"command\" type=\"orca.Command\" start_after=\"fuser\">\n"
         "    <param name=\"goals\" value=\"far: " +
         metres +
         " 0\"/><param name=\"behaviours\" value=\"goto\"/>\n"
         "  </component>\n"
         "  <connect from=\"command.goto\" to=\"goto.GotoCoordinateSend\"/>\n"
         "  <connect from=\"command.clients\" to=\"fuser.ClientListSend\"/>\n"
         "  <connect from=\"goto.ArrivedPush\" to=\"command.arrived\"/>\n"
         "  <connect from=\"goto.MotionCmdPush\" to=\"fuser.motion\"/>\n"
         "  <connect from=\"fuser.base\" to=\"base.MotionCommandSend\"/>\n"
         "  <connect from=\"base.OdometryPush\" to=\"goto.odometry\"/>\n"
         "</graph>\n";
}

// What the log says from its first line with `begin` on.
std::string from(const std::string& log, const std::string& begin) {
  const std::size_t at = log.find(begin);
  return at == std::string::npos ? "" : log.substr(at);
}

// A robot that drives to its goal.
class Way {
 public:
  explicit Way(const std::string& metres = "3")
      : program_(deployer(
            {folder_.write("driver_swap.xml", graph(folder_.file("place"), metres)), "--log", "debug"})) {
    REQUIRE(waits_for("cart 1 moves"));
  }

  bool waits_for(const std::string& text) { return program_.wait_for_output(text, Seconds(60) * kSlowdown); }
  static Run swap(const std::string& plugin, const Words& more = {}) {
    return run_orcactl(Words{"swap", "cart", plugin} + more);
  }
  Run end() { return finish(program_, Seconds(30)); }

 private:
  TempFolder folder_;
  Subprocess program_;
};

}  // namespace

TEST_CASE(
    "a driver is exchanged on the way: the robot stands meanwhile, goes on from there, and reaches its goal",
    "[system][swap][driver]") {
  Way way;
  const Run swapped = Way::swap(next_version("test_cart_2"));
  INFO(swapped.err);
  REQUIRE(swapped.exit_code() == 0);
  CHECK_THAT(swapped.out, Contains("test.Cart"));
  REQUIRE(way.waits_for("cart 2 moves"));
  const Run shown = run_orcactl({"plugins"});
  CHECK_THAT(shown.out, Contains("test_cart_2.so") && !Contains("test_cart.so"));
  const Run run = way.end();
  INFO(run.err);
  CHECK(run.exit_code() == 0);
  REQUIRE(run.arrivals().size() == 1);
  CHECK(run.arrivals().front().x == Approx(3.0).margin(0.5));
  const std::string pause = from(from(run.err, "its driver is to be exchanged"), "cart 1 stops at once");
  CHECK(pause.find("cart 1 close") < pause.find("cart 2 open"));
  CHECK_THAT(pause, !Contains("cart 1 moves"));
  CHECK_THAT(run.err, !Contains("PLUGIN_PINNED"));
}

TEST_CASE("whoever would exchange what serves hardware is told how to exchange the driver",
          "[system][swap][driver]") {
  Way way;
  for (const Words& more : {Words{}, Words{"--only-try"}}) {
    const Run refused =
        run_orcactl(Words{"swap", "base", ORCA_BINARY_DIR "/plugins/goto.so:orca.Goto"} + more);
    CHECK(refused.exit_code() == 1);
    CHECK_THAT(
        refused.err,
        Contains("base: it serves hardware, and cannot be exchanged while that runs; orcactl swap cart "
                 "exchanges the driver"));
  }
  CHECK(way.end().exit_code() == 0);
}

TEST_CASE("a driver's parameters are shown, and changed by putting it in anew", "[system][swap][driver]") {
  Way way("4");
  CHECK_THAT(run_orcactl({"get", "cart.speed"}).out, Contains("0.5") && Contains("m/s"));
  const Run of_base = run_orcactl({"get", "base"});  // its own, and its driver's
  CHECK_THAT(of_base.out, Contains("cart") && Contains("speed") && Contains("trouble"));
  for (const std::string name : {"cart", "base"}) {
    const Run refused = run_orcactl({"set", name + ".speed", "0.4 m/s"});
    CHECK(refused.exit_code() == 1);
    CHECK_THAT(refused.err, Contains("cart.speed: a driver reads its parameters only when it begins") &&
                                Contains("orcactl swap cart ") &&
                                Contains("test_cart.so --set speed=\"0.4 m/s\""));
    CHECK_THAT(run_orcactl({"set", name + ".speed", "0.4 kg"}).err, Contains("speed") && Contains("m/s"));
  }
  CHECK_THAT(run_orcactl({"get", "base.sped"}).err, Contains("did you mean \"speed\"?"));
  const Run swapped =
      Way::swap(ORCA_BINARY_DIR "/tests/host_plugins/test_cart.so", {"--set", "speed=0.4 m/s"});
  INFO(swapped.err);
  REQUIRE(swapped.exit_code() == 0);
  CHECK_THAT(run_orcactl({"get", "base.speed"}).out, Contains("0.4"));
  const Run run = way.end();
  CHECK(run.exit_code() == 0);
  CHECK(run.arrivals().size() == 1);
}

TEST_CASE("a driver that fails is gone again, and the robot goes on with the one that it had",
          "[system][swap][driver]") {
  Way way("4");
  for (const std::string trouble : {"open", "start", "throw", "block"}) {
    const Run refused = Way::swap(next_version("test_cart_2"), {"--set", "trouble=" + trouble});
    INFO(trouble << refused.err);
    CHECK(refused.exit_code() == 1);
    CHECK_THAT(refused.err, Contains("the new driver failed, and the old one is back"));
  }
  // The process has not been ended, although "block" takes longer than it may hang.
  CHECK_THAT(run_orcactl({"alarms"}).out,
             Contains("SWAP_UNDONE") && !Contains("HARDWARE_FAULT") && !Contains("PROCESS_ENDED"));
  CHECK_THAT(run_orcactl({"plugins"}).out, Contains("test_cart.so") && !Contains("test_cart_2.so"));
  const Run run = way.end();
  INFO(run.err);
  CHECK(run.exit_code() == 0);
  CHECK(run.arrivals().size() == 1);
}

TEST_CASE("a driver that hangs while it is made is refused after 10 s, and the robot does not even stop",
          "[system][swap][driver]") {
  Way way("8");
  const Run refused = Way::swap(next_version("test_cart_2"), {"--set", "trouble=sleep"});
  INFO(refused.err);
  CHECK(refused.exit_code() == 1);
  CHECK_THAT(refused.err, Contains("the new driver did not return within 10 s"));
  CHECK_THAT(run_orcactl({"plugins"}).out, Contains("test_cart.so"));
  REQUIRE(Way::swap(next_version("test_cart_2")).exit_code() == 0);  // nothing is under way any more
  const Run run = way.end();
  INFO(run.err);
  const std::string asked = from(run.err, "its driver is to be exchanged");
  CHECK_THAT(asked.substr(0, asked.find("its driver is to be exchanged", 1)), !Contains("stops at once"));
  CHECK(run.arrivals().size() == 1);
}

TEST_CASE("a driver that computes for ever while it is made costs its process, which begins anew",
          "[system][swap][driver]") {
  Way way("12");
  const Run refused = Way::swap(next_version("test_cart_2"), {"--set", "trouble=spin"});
  INFO(refused.err);
  CHECK(refused.exit_code() == 1);
  REQUIRE(way.waits_for("computes without end, so the process is ended"));
  bool is_back = false;
  for (int tries = 0; tries < 50 && !is_back; ++tries) {
    std::this_thread::sleep_for(100ms);
    is_back = Way::swap(next_version("test_cart_2")).exit_code() == 0;
  }
  CHECK(is_back);
}

TEST_CASE("what cannot take a driver's place is refused with all reasons, and the robot does not even stop",
          "[system][swap][driver]") {
  Way way;
  const std::vector<std::pair<std::string, std::string>> bad{
      {"/nowhere/new.so", "No such file or directory"},
      {next_version("test_cart_odd"),
       "it delivers Odometry every 0.1 s, and the present one every 0.05 s; it has no "},
      {next_version("test_cart_2") + ":test.Other", "has no hardware type \"test.Other\""},
      {next_version("test_teller_2"), "has no hardware type \"test.Cart\""}};
  for (const auto& [plugin, reason] : bad) {
    const Run refused = Way::swap(plugin);
    INFO(plugin << refused.err);
    CHECK(refused.exit_code() == 1);
    CHECK_THAT(refused.err, Contains(reason));
  }
  CHECK_THAT(Way::swap(next_version("test_cart_2"), {"--set", "speed=3"}).err, Contains("speed"));
  const Run run = way.end();
  CHECK(run.exit_code() == 0);
  CHECK_THAT(run.err, !Contains("cart 2"));
  CHECK_THAT(from(run.err, "cart 1 open").substr(1), !Contains("cart 1 open"));
}
