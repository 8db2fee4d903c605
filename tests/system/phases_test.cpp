// SPDX-License-Identifier: GPL-3.0-or-later
// The three phases of a typical run (thesis Fig. 11.7-11.9), read from the trace of the thesis's run.
#include <catch2/catch.hpp>

#include "deployer.hpp"
#include "temp_folder.hpp"
#include "trace_file.hpp"

using namespace orca::test;

namespace {

const TraceFile& trace() {
  static const TempFolder folder;
  static const TraceFile file = [] {
    const std::string path = folder.file("trace");
    const Run run =
        run_deployer(Words{source_file("graphs/scout_goto.xml"), "--trace", path} + virtual_clock());
    INFO(run.err);
    REQUIRE(run.exit_code() == 0);
    return TraceFile(path);
  }();
  return file;
}

// Returns the index of the first line of an event.
std::size_t when(const std::string& event, const std::vector<std::string>& words) {
  const std::size_t index = trace().find(event, words);
  CAPTURE(event, words);
  REQUIRE(index != TraceFile::kNever);
  return index;
}

std::size_t connects(const std::string& client, const std::string& server) {
  return when("connect", {client, server});
}

std::size_t arrival(int number) {
  std::size_t index = when("deliver", {"command", "arrived"});
  for (int i = 1; i < number; ++i) index = trace().find("deliver", {"command", "arrived"}, index + 1);
  REQUIRE(index != TraceFile::kNever);
  return index;
}

std::size_t count_deliveries(const std::string& component, const std::string& port, const std::string& origin,
                             std::size_t end) {
  std::size_t count = 0;
  for (std::size_t i = 0; i < end; ++i) {
    const TraceLine& line = trace().lines()[i];
    count += line.is("deliver", {component, port}) && line.words.back() == origin ? 1 : 0;
  }
  return count;
}

const std::vector<std::string> kAllConnections{"avoid.goal goto.GoalPush",
                                               "avoid.localizer localizer.RobotPosePush",
                                               "avoid.odometry base.OdometryPush",
                                               "avoid.sonar base.SonarRangeReadingsPush",
                                               "command.arrived goto.ArrivedPush",
                                               "command.failed goto.GoalFailedPush",
                                               "fuser.motion avoid.motion",
                                               "fuser.motion goto.MotionCmdPush",
                                               "goto.localizer localizer.RobotPosePush"};

}  // namespace

TEST_CASE("before the command acts, everything is idle and nothing is connected", "[system][phases]") {
  const std::size_t start = when("state", {"command", "IDLE", "CONNECT"});
  CHECK(trace().open_connections(start).empty());
  CHECK(trace().state_before("scout", start) == "Ready");
  for (const char* name : {"goto", "avoid", "fuser", "base", "localizer"})
    CHECK(trace().state_before(name, start) == "IDLE");
}

TEST_CASE(
    "initialisation, Fig. 11.7: the command sends the goal and the behaviours, and connections cascade down "
    "to the hardware",
    "[system][phases]") {
  const std::size_t goal = when("deliver", {"goto", "GotoCoordinateSend"});
  const std::size_t clients = when("deliver", {"fuser", "ClientListSend"});
  const std::size_t arrived = connects("command.arrived", "goto.ArrivedPush");
  const std::size_t localizer = connects("goto.localizer", "localizer.RobotPosePush");
  const std::size_t wishes = connects("fuser.motion", "avoid.motion");
  const std::size_t sonar = connects("avoid.sonar", "base.SonarRangeReadingsPush");
  const std::size_t active = when("state", {"scout", "Ready", "Active"});
  CHECK(when("state", {"command", "CONNECT", "WORK"}) < goal);
  CHECK(goal < clients);
  CHECK(clients < wishes);
  CHECK(clients < connects("fuser.motion", "goto.MotionCmdPush"));
  CHECK(arrived < localizer);
  CHECK(wishes < sonar);
  CHECK(std::min(localizer, sonar) < active);
}

TEST_CASE("initialisation: a component connects to its providers after its first client has come",
          "[system][phases]") {
  for (const auto& [name, client, server] :
       {std::tuple{"goto", "command.arrived", "goto.ArrivedPush"},
        std::tuple{"avoid", "fuser.motion", "avoid.motion"},
        std::tuple{"localizer", "goto.localizer", "localizer.RobotPosePush"},
        std::tuple{"base", "avoid.sonar", "base.SonarRangeReadingsPush"}}) {
    CAPTURE(name);
    CHECK(connects(client, server) < when("state", {name, "IDLE", "CONNECT"}));
    CHECK(when("state", {name, "IDLE", "CONNECT"}) < when("state", {name, "CONNECT", "WORK"}));
  }
}

TEST_CASE(
    "running, Fig. 11.8: readings, poses and wishes are pushed again and again, and the fuser commands the "
    "base",
    "[system][phases]") {
  const std::size_t reached = arrival(1);
  CHECK(count_deliveries("avoid", "sonar", "base", reached) > 20);
  CHECK(count_deliveries("goto", "localizer", "localizer", reached) > 20);
  CHECK(count_deliveries("fuser", "motion", "goto", reached) > 20);
  CHECK(count_deliveries("fuser", "motion", "avoid", reached) > 20);
  CHECK(count_deliveries("base", "MotionCommandSend", "fuser", reached) > 20);
  CHECK(trace().open_connections(reached) == kAllConnections);
  CHECK(trace().state_before("scout", reached) == "Active");
}

TEST_CASE("running: nothing is pushed before the hardware is active", "[system][phases]") {
  const std::size_t active = when("state", {"scout", "Ready", "Active"});
  CHECK(active < when("deliver", {"avoid", "sonar"}));
  CHECK(active < when("deliver", {"goto", "localizer"}));
}

TEST_CASE("closing, Fig. 11.9: after the last goal every connection is shut down and the hardware is idle",
          "[system][phases]") {
  const std::size_t last = arrival(3);
  const std::size_t end = when("state", {"scout", "Ready", "Closed"});  // the shutdown begins
  REQUIRE(last < end);
  for (const std::string& connection : kAllConnections) {
    const auto gap = connection.find(' ');
    CAPTURE(connection);
    CHECK(trace().has("disconnect", {connection.substr(0, gap), connection.substr(gap + 1)}, last));
  }
  CHECK(trace().open_connections(end).empty());
  for (const char* name : {"goto", "avoid", "fuser", "base", "localizer"}) {
    CAPTURE(name);
    CHECK(trace().state_before(name, end) == "IDLE");
  }
  CHECK(trace().state_before("scout", end) == "Ready");
}

TEST_CASE("closing: the fuser's last command reaches the base before it goes idle, and no reading follows",
          "[system][phases]") {
  const std::size_t idle = trace().find("state", {"scout", "Active", "Ready"}, arrival(3));
  REQUIRE(idle != TraceFile::kNever);
  CHECK(trace().find("deliver", {"base", "MotionCommandSend"}, arrival(3)) < idle);
  CHECK_FALSE(trace().has("deliver", {"avoid", "sonar"}, idle));
  CHECK_FALSE(trace().has("deliver", {"goto", "localizer"}, idle));
}

TEST_CASE("in the end every component has left, and the hardware is closed", "[system][phases]") {
  for (const char* name : {"command", "goto", "avoid", "fuser", "base", "localizer"})
    CHECK(trace().state_before(name) == "EXIT");
  CHECK(trace().state_before("scout") == "Closed");
}
