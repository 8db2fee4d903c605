// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// A deployer with several host processes, each of which may die at any moment.
#pragma once

#include <signal.h>

#include <algorithm>
#include <catch2/catch.hpp>
#include <chrono>
#include <cstdio>
#include <filesystem>
#include <map>
#include <memory>
#include <random>
#include <sstream>
#include <string>
#include <thread>
#include <vector>

#include "deployer.hpp"
#include "process_table.hpp"

namespace orca::test {

using Clock = std::chrono::steady_clock;

inline constexpr Seconds kMoment{0.001};  // between two looks at what happens

inline Seconds since_boot() { return Clock::now().time_since_epoch(); }

using Nobody = std::vector<std::string>;

// Copies a plugin into a folder, with the list of its types, which lies beside it.
inline void copy_plugin(std::filesystem::path from, const std::filesystem::path& folder) {
  std::filesystem::copy_file(from, folder / from.filename());
  from.replace_extension(".types");
  std::filesystem::copy_file(from, folder / from.filename());
}

// Waits until something is so; false if it is not in time.
template <class Condition>
bool comes_true(const Condition& condition, Seconds limit) {
  const Seconds end = since_boot() + limit * kSlowdown;
  while (!condition()) {
    if (since_boot() > end) return false;
    std::this_thread::sleep_for(kMoment);
  }
  return true;
}

// The deployer of a system whose processes go on without it, and the one before.
class Deployers {
 public:
  // Starts a deployer; one that runs is killed before. Waits until the log has the sign.
  void start(const std::string& file, const std::string& sign) {
    if (now_) {
      now_->send(SIGKILL);
      REQUIRE(now_->wait(Seconds(2) * kSlowdown));
      killed_ = std::move(now_);  // with its object, what it has started would end
    }
    now_ = std::make_unique<Subprocess>(deployer({file, "--log", "debug"}));
    REQUIRE(now_->wait_for_output(sign, Seconds(20) * kSlowdown));
  }
  // Forgets a deployer that has ended.
  void forget() { now_.reset(); }
  Subprocess& operator*() const { return *now_; }
  Subprocess* operator->() const { return now_.get(); }

 private:
  std::unique_ptr<Subprocess> killed_;
  std::unique_ptr<Subprocess> now_;
};

// Ends a system of tellers, and checks that none of them has missed an object. Returns its log.
inline std::string stop_without_gaps(Subprocess& program) {
  CHECK(run_orcactl({"stop"}).exit_code() == 0);
  const Run run = finish(program, Seconds(10));
  INFO(run.err);
  CHECK(run.exit_code() == 0);
  CHECK(run.err.find("gap ") == std::string::npos);
  return run.err;
}

// A deployer whose host processes are looked at.
class System {
 public:
  explicit System(const Words& words) : program_(deployer(words)) {}
  ~System() {
    for (const auto& [name, pid] : known_) kill(pid, SIGKILL);
  }
  System(const System&) = delete;
  System& operator=(const System&) = delete;

  Subprocess& program() { return program_; }

  // Waits for a host process, another than one that is lost, and returns its number.
  pid_t process(const std::string& name, pid_t lost = 0) {
    const auto is_there = [&] {
      const auto children = this->children();
      const auto found = children.find(name);
      if (found == children.end() || found->second == lost) return false;
      known_[name] = found->second;
      return true;
    };
    REQUIRE(comes_true(is_there, Seconds(5)));
    return known_[name];
  }

  std::size_t mark() const { return program_.err().size(); }
  // Returns when the log came to hold a text behind a mark [since boot]; fails the test if it does not.
  Seconds when(const std::string& text, std::size_t mark, Seconds limit = Seconds(5)) {
    const bool came = comes_true([&] { return program_.err().find(text, mark) != std::string::npos; }, limit);
    INFO(program_.err());
    INFO(text);
    REQUIRE(came);
    return since_boot();
  }

  // Waits for objects that come through none of the lost processes, and returns when the first of them came.
  Seconds flows_without(pid_t lost, std::size_t mark, Seconds limit = Seconds(10)) {
    Seconds at{0};
    const auto look = [&] {
      for (const std::string& line : split_lines(program_.err().substr(mark)))
        if (at = flow_time(line, lost); at > Seconds(0)) return true;
      return false;
    };
    const bool came = comes_true(look, limit);
    INFO(program_.err());
    REQUIRE(came);
    return at;
  }

  // Returns who of its processes still lives, the deployer too.
  std::vector<std::string> left() const { return living_in_group(program_.pid()); }

  std::map<std::string, pid_t> children() const { return children_of(program_.pid()); }

 private:
  // Reads a line "flow SOURCE RELAY SINK at SECONDS" in which a process has no part; 0 if it is none.
  static Seconds flow_time(const std::string& line, pid_t lost) {
    const std::size_t begin = line.find("flow ");
    if (begin == std::string::npos) return Seconds(0);
    std::istringstream words(line.substr(begin));
    std::string word;
    pid_t source = 0, relay = 0, sink = 0;
    double at = 0.0;
    words >> word >> source >> relay >> sink >> word >> at;
    const bool complete = !words.fail();
    return complete && source != lost && relay != lost && sink != lost ? Seconds(at) : Seconds(0);
  }

  Subprocess program_;
  std::map<std::string, pid_t> known_;  // killed at the end, if they have outlived the deployer
};

// Returns the words that start a flow whose processes are joined by this link.
inline Words flow(const std::string& link = "shm") {
  return Words{system_graph("flow.xml"), "--set", "link=" + link} + with_test_plugins();
}

// Ends a system by SIGTERM and checks that it ends well.
inline Run stop(System& system) {
  system.program().send(SIGTERM);
  const Run run = finish(system.program(), Seconds(5));
  INFO(run.err);
  CHECK(run.exit_code() == 0);
  CHECK(system.left() == Nobody{});
  return run;
}

struct Outage {
  Seconds detected{0};
  Seconds back{0};
  Seconds flows{0};
};

// Kills a process of the flow and waits until objects come again. Times are counted from the kill.
inline Outage kill_one(System& system, const std::string& name) {
  const pid_t lost = system.process(name);
  const std::size_t mark = system.mark();
  const Seconds killed = since_boot();
  REQUIRE(kill(lost, SIGKILL) == 0);
  Outage outage;
  outage.detected = system.when("process " + name + " was ended by SIGKILL", mark) - killed;
  outage.back = system.when("process " + name + " is back", mark, Seconds(10)) - killed;
  outage.flows = system.flows_without(lost, mark) - killed;
  CHECK(system.process(name) != lost);
  return outage;
}

inline double percentile(std::vector<double> values, double share) {
  std::ranges::sort(values);
  return values[static_cast<std::size_t>(share * static_cast<double>(values.size() - 1))];
}

inline void print(const char* what, const std::vector<double>& values) {
  std::printf("%-26s median %6.3f s, p95 %6.3f s, longest %6.3f s\n", what, percentile(values, 0.5),
              percentile(values, 0.95), percentile(values, 1.0));
}

// Kills processes of a flow at random moments and prints what it took.
inline void kill_many(int times, const std::string& link) {
  constexpr unsigned kSeed = 20040612;
  std::mt19937 random(kSeed);
  const auto dice = [&](double most) { return most * static_cast<double>(random()) / std::mt19937::max(); };
  const std::vector<std::string> names{"source", "relay", "sink"};
  std::vector<double> detected, back, flows;
  System system(flow(link));
  system.when("flow ", 0, Seconds(10));
  for (int i = 0; i < times; ++i) {
    std::this_thread::sleep_for(Seconds(0.15 + dice(0.5)));
    CAPTURE(kSeed, i, link);
    const Outage outage = kill_one(system, names[random() % names.size()]);
    detected.push_back(outage.detected.count());
    back.push_back(outage.back.count());
    flows.push_back(outage.flows.count());
  }
  stop(system);
  std::printf("%d kills, link %s\n", times, link.c_str());
  print("kill to alarm", detected);
  print("kill to process back", back);
  print("kill to objects again", flows);
  CHECK(percentile(detected, 1.0) < 0.5);
  CHECK(percentile(flows, 0.95) < 3.0);
}

}  // namespace orca::test
