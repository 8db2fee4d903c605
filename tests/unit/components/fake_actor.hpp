// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <catch2/catch.hpp>
#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "task_tree/task_run.hpp"

namespace orca::tasks::test {

using State = TaskRun::State;
using Strings = std::vector<std::string>;

/// A robot that does what it is told in two ticks, except where a test says otherwise, and notes it all.
struct FakeActor final : Actor, Setter {
  Strings log;
  std::map<std::string, Strings> failures;  // by goal: reasons, one for each time; then it is reached
  std::set<std::string> endless;            // goals that are never reached
  std::set<std::string> alarms;
  std::map<std::string, std::string> fields;  // that conditions look at: "battery.charge"
  std::set<std::string> refused;              // goals that nobody takes
  bool answer = true;
  int begun = 0;
  std::uint64_t orders = 0;
  std::set<std::uint64_t> asked;  // numbers of orders
  bool may_set = true;
  bool is_deaf = false;  // nobody answers orders

  std::optional<Ending> begin(const Step& step) override {
    const std::string& name = step.kind == Kind::ask ? step.words : step.trip.name;
    log.push_back("begin " + name);
    ++begun;
    if (refused.contains(name)) return Ending{false, "refused: nobody takes it"};
    return std::nullopt;
  }
  std::optional<Ending> go_on(const Step& step) override {
    if (step.kind == Kind::ask) return Ending{answer, answer ? "" : "answered: no"};
    const std::string& name = step.trip.name;
    if (endless.contains(name)) return std::nullopt;
    if (Strings& reasons = failures[name]; !reasons.empty()) {
      const std::string reason = reasons.front();
      reasons.erase(reasons.begin());
      return Ending{false, reason};
    }
    log.push_back("at " + name);
    return Ending{true, {}};
  }
  Setter& setter() override { return *this; }
  std::uint64_t order(const Step& step) override {
    log.push_back(step.kind == Kind::suspend ? "suspend " + step.component
                                             : "set " + step.param + " " + step.words);
    return ++orders;
  }
  std::optional<Ending> outcome(std::uint64_t number) override {
    asked.insert(number);
    if (is_deaf) return std::nullopt;
    return may_set ? Ending{true, "0.5 m/s"} : Ending{false, "no right"};
  }
  void set_back(const Step& step, std::uint64_t number, const std::string& before) override {
    log.push_back("back " + (step.kind == Kind::suspend ? step.component : step.param) + " " +
                  (number != 0 ? "after its order" : before));
  }
  void halt(const Step& step) override { log.push_back("halt " + step.trip.name); }
  void say(const std::string& text) override { log.push_back("say " + text); }
  bool holds(const Condition& condition) override {
    return orca::tasks::holds(
        condition, {[this](const std::string& kind, const std::string&) { return alarms.contains(kind); },
                    [this](const std::string& port, const std::string& field) {
                      const auto found = fields.find(port + "." + field);
                      return found == fields.end() ? std::nullopt : std::optional(found->second);
                    }});
  }
};

inline Task task_of(const std::string& steps) {
  orca::xml::Diagnostics diagnostics;
  const auto task =
      read_task_text("<task name=\"test\" version=\"1\">" + steps + "</task>", "test.xml", {}, diagnostics);
  INFO(diagnostics.text());
  REQUIRE((task && !diagnostics.has_errors()));
  return *task;
}

// Returns a task of graphs/tasks.
inline Task shipped_task(const std::string& name) {
  const std::vector<Sight> sights{{"battery", {"voltage", "temperature"}}, {"localization", {"share"}}};
  orca::xml::Diagnostics diagnostics;
  const auto task = read_task(ORCA_SOURCE_DIR "/graphs/tasks/" + name + ".xml", sights, diagnostics);
  INFO(diagnostics.text());
  REQUIRE((task && !diagnostics.has_errors()));
  return *task;
}

/// A task that is advanced ten times a second.
struct Run {
  explicit Run(const std::string& steps) : Run(task_of(steps)) {}
  explicit Run(Task of) : task(std::move(of)), run(task) {}

  void tick(int times = 1) {
    for (int i = 0; i < times && run.state() != State::done && run.state() != State::failed; ++i) {
      run.tick(actor, time);
      time = 0.1 * ++ticks;
    }
  }
  State to_the_end() {
    tick(10000);
    return run.state();
  }

  Task task;
  TaskRun run;
  FakeActor actor;
  int ticks = 0;
  double time = 0.0;
};

inline std::string reason_of(const Run& run) { return run.run.memories()[0].reason; }

}  // namespace orca::tasks::test
