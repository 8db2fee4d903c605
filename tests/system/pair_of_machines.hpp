// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <signal.h>

#include <catch2/catch.hpp>

#include <chrono>
#include <iostream>
#include <memory>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "deployer.hpp"
#include "process_table.hpp"
#include "two_machines.hpp"

namespace orca::test {

inline const std::string kMachines[] = {"base", "brain"};

inline const std::string kFlows = system_graph("machines.xml");
inline const std::string kDrive = source_file("graphs/two_machines.xml");
inline const std::string kNear = "goals=hall: 3.6 6 > 3.6 7.6";

inline Words on_machine(const std::string& graph, const std::string& name, const Words& settings = {}) {
  Words words = Words{graph, "--machine", name};
  if (graph == kFlows) words = words + with_test_plugins();
  for (const std::string& setting : settings) words = words + Words{"--set", setting};
  return words;
}

/// A deployer on each of two machines.
///
/// Thread contract: one thread.
class Pair {
 public:
  explicit Pair(Words settings = {}, std::string graph = kFlows)
      : graph_(std::move(graph)), settings_(std::move(settings)) {}
  ~Pair() {
    for (const auto& program : programs_)
      if (program)
        for (const auto& [name, pid] : children_of(program->pid())) kill(pid, SIGKILL);
  }
  Pair(const Pair&) = delete;
  Pair& operator=(const Pair&) = delete;

  void start(int machine) { start(machine, settings_); }
  /// @param options  words of the command line beside the settings.
  void start(int machine, const Words& settings, const Words& options = {}) {
    programs_[machine] = std::make_unique<Subprocess>(network_.on(
        machine, clocks_[machine] + deployer(on_machine(graph_, kMachines[machine], settings) + options)));
  }
  /// Sets the time of day of a machine, for deployers that are started from now on.
  void set_clock(int machine, int ahead) {
    clocks_[machine] = {"/usr/bin/env", "LD_PRELOAD=" ORCA_SET_CLOCK,
                        "ORCA_TEST_CLOCK_AHEAD=" + std::to_string(ahead)};
  }
  void start_both() {
    for (const int machine : {0, 1}) start(machine);
  }
  // Kills the deployer of a machine, and starts another one. What the first has started may live on.
  void replace(int machine) {
    at(machine).send(SIGKILL);
    REQUIRE(at(machine).wait(Seconds(2) * kSlowdown));
    killed_.push_back(std::move(programs_[machine]));
    start(machine);
  }
  void flow(int machine) { says(machine, "flow ", 0, Seconds(15)); }

  Subprocess& at(int machine) { return *programs_[machine]; }
  const TwoMachines& network() const { return network_; }
  std::size_t mark(int machine) { return at(machine).err().size(); }

  // Waits until a machine has said something behind a mark of its log.
  void says(int machine, const std::string& text, std::size_t mark = 0, Seconds limit = Seconds(5)) {
    const auto end = std::chrono::steady_clock::now() + limit * kSlowdown;
    while (at(machine).err().find(text, mark) == std::string::npos) {
      INFO(kMachines[machine] << ":\n" << at(machine).err());
      INFO(text);
      REQUIRE(std::chrono::steady_clock::now() < end);
      std::this_thread::sleep_for(Seconds(0.01));
    }
  }

  /// Runs orcactl on a machine to its end.
  Run orcactl(int machine, const Words& words, Seconds limit = Seconds(20)) const {
    Subprocess program(network_.on(machine, orca::test::orcactl(words)));
    return orca::test::finish(program, limit);
  }

  Run finish(int machine, Seconds limit = Seconds(5)) { return orca::test::finish(at(machine), limit); }

  // Stops one machine, and checks that both end well.
  void stop(int machine) {
    at(machine).send(SIGINT);
    for (const int each : {machine, 1 - machine}) {
      const Run run = finish(each);
      INFO(kMachines[each] << ":\n" << run.err);
      CHECK(run.exit_code() == 0);
      CHECK(living_in_group(at(each).pid()).empty());
    }
  }

 private:
  const std::string graph_;
  const Words settings_;
  const TwoMachines network_;
  Words clocks_[2];  // what precedes the command of a deployer
  std::unique_ptr<Subprocess> programs_[2];
  std::vector<std::unique_ptr<Subprocess>> killed_;  // end what they have started
};

/// Tells why the test is skipped, if it is.
inline bool is_skipped() {
  const std::string reason = TwoMachines::why_not();
  if (!reason.empty()) std::cout << "SKIPPED: " << reason << "\n";
  return !reason.empty();
}

}  // namespace orca::test
