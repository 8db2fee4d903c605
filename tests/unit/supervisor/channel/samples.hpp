// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <fcntl.h>

#include <cstddef>
#include <string>
#include <utility>
#include <vector>

#include "orca/supervisor/control.hpp"
#include "orca/supervisor/vocabulary.hpp"

namespace orca::test {

/// Returns a descriptor of a file that everybody knows.
inline Descriptor null_device() { return Descriptor(open("/dev/null", O_RDWR | O_CLOEXEC)); }

inline std::vector<std::byte> some_bytes() { return {std::byte{1}, std::byte{0}, std::byte{255}}; }

inline supervisor::Setup setup() {
  supervisor::Setup setup{"base", "<graph/>",      {{"seed", "7"}, {"profile", "sim"}},     null_device(),
                          {},     {"a", "b", "c"}, {{"a", "test.Teller", 1, some_bytes()}}, {"base", ""}};
  setup.edges.push_back({"a.out to b.in", null_device(), "arm", null_device()});
  setup.edges.push_back({"b.out to c.in", null_device(), "arm"});
  setup.pool = null_device();
  return setup;
}

inline supervisor::Rewire rewire() {
  graph::Edge made;
  made.from = {"a", "out"};
  made.to = {"b", "in"};
  made.pattern = Pattern::send;
  made.queue = {.depth = 7,
                .overflow = QueuePolicy::Overflow::block,
                .min_interval = Duration{0},
                .deadline = from_seconds(0.5),
                .block_limit = from_seconds(0.25),
                .drop_limit = 3,
                .confirm = QueuePolicy::Confirm::handled};
  made.interval = from_seconds(0.1);
  made.link = graph::Link::shm;
  made.choice = 2;
  graph::Edge removed;
  removed.from = {"c", "out"};
  supervisor::Rewire rewire;
  rewire.changes.push_back({made, true, null_device()});
  rewire.changes.push_back({removed, false});
  return rewire;
}

inline supervisor::AddComponent newcomer() {
  supervisor::AddComponent added;
  added.node.name = "avoid";
  added.node.type = "orca.SonarAvoid";
  added.node.hardware = "scout";
  added.node.process = "behaviours";
  added.node.priority = -7;
  added.node.autonomous = true;
  added.node.trigger =
      Trigger{Trigger::Kind::on_stamps, from_seconds(0.5), {"sonar", "odometry"}, from_seconds(0.01)};
  added.node.ports["motion"].alias = "wish";
  added.values = {{"stop_distance", "0.5 m"}};
  added.doorbell = 9;
  return added;
}

template <class Words, class... Word>
std::vector<Words> list_of(Word... word) {
  std::vector<Words> words;
  (words.emplace_back(std::move(word)), ...);
  return words;
}

/// Returns one of each order.
inline std::vector<supervisor::Order> all_orders() {
  using namespace supervisor;
  return list_of<Order>(
      setup(), Build{}, OpenHardware{}, Configure{"avoid"}, OpenGates{}, TakeDown{true}, StopMotors{"estop"},
      Suspend{"avoid"}, Resume{"avoid"}, SetParams{"avoid", {{"stop_distance", "0.5 m"}}},
      RenewEdge{{"a.out to b.in", null_device()}}, CutEdge{"a.out to b.in", "process \"base\" has crashed"},
      TellAlarm{"base", some_bytes()}, ForgetAlarm{"FAILED", "avoid", "behaviours"}, ReleaseMotors{}, Count{},
      OpenLine{{{"base", "OdometryPush"}, {"base", "SonarPush"}}, true, false, 1000, null_device()},
      Meet{"peers",
           "orca::idl::MachineState",
           "orca/robot/machines",
           "10.0.0.1",
           "wlan0",
           {"10.0.0.2"},
           3,
           "/keys/robot/base"},
      Say{some_bytes()}, Outlive{null_device(), 60'000'000'000}, Adopt{}, MoveEdge{"a.out to b.in"}, AskUse{},
      TellLines{{{log::Level::warning, "goto", "lost", 12}, {log::Level::info, "base", "", 13}}},
      SwapCode{"avoid",
               "orca.VfhPlus",
               {{"margin", "0.1 m"}},
               2'000'000'000,
               "/tmp/vfh_plus.so",
               null_device(),
               true},
      NoteGraph{"<graph name=\"robot\"/>"}, rewire(), newcomer(), RemoveComponent{"avoid"}, OpenGate{"avoid"},
      NoteProcess{"brain", 2, true}, ConcludeCall{"task", 3, ok(), "0.5 m/s"});
}

/// Returns at least one of each report.
inline std::vector<supervisor::Report> all_reports() {
  using namespace supervisor;
  return list_of<Report>(
      Answer{}, Answer{fail(Code::deadline_exceeded, "too late", "a.xml:1:2")},
      Built{{{"hardware", "scout"}}}, StateChange{"avoid", 6, "no echo", true, true, true}, RestChange{true},
      ArrivedReport{some_bytes()}, GoalFailedReport{some_bytes()}, ContactReport{{}},
      AlarmReport{some_bytes()}, HeardReport{some_bytes()}, Logged{log::Level::warning, "avoid", "text"},
      LastWordsReport{"SIGSEGV"}, Tally{{{"3", {1, 2}}}, {{"goto.send", {4}}}, {}, {{"base", {12'000}}}},
      OutputFailed{fail(Code::unavailable, "no space", "run.csv")},
      EdgeDamaged{"goto.motion to fuser.motion"}, Glance{{{"scout", "Fault"}}, {{"kitchen", {2'500}}}},
      Prompting{false}, Answer{ok(), {{{"name", "goto"}, {"restarts", 3}, {"active", true}}, {}}},
      MissionStep{7, 1'000'000, "command.goto", "GoalPoint", 2, "goto", "arrived", 5},
      Orphaned{"base", 17, {{"seed", "7"}}, null_device(), null_device(), {"base", "avoid"}, {"main"}},
      ExchangedCode{"avoid", "orca.VfhPlus", "/tmp/vfh_plus.so", "abc", 3},
      ExchangedCode{
          "goto",
          "orca.Goto",
          "/tmp/goto.so",
          "abc",
          1,
          {{"radius", ParamType::real, "m", 0.1, std::nullopt, {}, false, true, 0.5, "text"},
           {"wheels",
            ParamType::text_list,
            "",
            {},
            {},
            {"left"},
            true,
            false,
            std::vector<std::string>{"left"},
            ""}},
          {{"radius", 0.25}, {"laps", std::int64_t{-3}}, {"backs", true}, {"who", std::string("me")}}},
      Standing{{{"base", some_bytes()}}, true, {{"avoid", {{"stop_distance", "0.5 m"}}}}}, Leaving{},
      LogWished{true}, StateKept{"command", "orca.Command", 2, some_bytes()},
      PeerCalled{"task", 3, PeerCalled::Act::set, "pilot", "max_speed", "0.8 m/s"});
}

/// Returns one of each word that a client of the control socket hears.
inline std::vector<supervisor::ControlAnswer> all_answers() {
  using namespace supervisor;
  return list_of<ControlAnswer>(
      RecordAnswer{{{"name", "goto"}, {"pid", 42}, {"active", true}}}, TextAnswer{"<graph/>"},
      NoteAnswer{"only a part"}, LineAnswer{null_device(), "Ask", "ClientList", {"a.ask", "b.ask"}},
      EndAnswer{ok()}, EndAnswer{fail(Code::not_found, "there is no component \"gto\"")});
}

/// Returns one of each word on a line to a port.
inline std::vector<supervisor::LineWord> all_line_words() {
  using namespace supervisor;
  return list_of<LineWord>(Tapped{"Odometry", some_bytes(), 3, 2, 4, 1, 5}, EndLine{}, LineEnded{{0, 3}},
                           Offer{"Ask", some_bytes()}, OfferOutcome{ok(), "ClientList", some_bytes()},
                           OfferOutcome{fail(Code::unavailable, "full"), "", {}});
}

}  // namespace orca::test
