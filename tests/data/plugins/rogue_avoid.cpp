// SPDX-License-Identifier: GPL-3.0-or-later
// An avoider that is as bad as its parameters say. What happens where they have no values yet is chosen by definitions:
//   ROGUE_CONSTRUCTOR, ROGUE_UNLOADING   the deed in its constructor, or when its code is unloaded
#include <fcntl.h>
#include <signal.h>
#include <sys/resource.h>
#include <unistd.h>

#include <cstddef>
#include <cstdlib>
#include <fstream>
#include <functional>
#include <map>
#include <memory>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include "orca/component.hpp"
#include "orca/idl/hardware.hpp"
#include "orca/idl/motion.hpp"
#include "orca/idl/navigation.hpp"
#include "orca/idl/sensing.hpp"
#include "orca/idl/system.hpp"

#ifndef ROGUE_CONSTRUCTOR
#define ROGUE_CONSTRUCTOR "none"
#endif
#ifndef ROGUE_UNLOADING
#define ROGUE_UNLOADING "none"
#endif

namespace {

void take_memory() {
  static std::vector<std::unique_ptr<std::vector<char>>> taken;
  taken.push_back(std::make_unique<std::vector<char>>(std::size_t{1} << 20, 'x'));
}

void start_thread() {
  std::thread([] {
    for (;;) sleep(1);
  }).detach();
}

const std::map<std::string, std::function<void()>>& deeds() {
  static const std::map<std::string, std::function<void()>> all{
      {"none", [] {}},
      {"abort", [] { std::abort(); }},
      {"crash", [] { raise(SIGSEGV); }},
      {"eat",
       [] {
         for (;;) take_memory();
       }},
      {"exit", [] { std::exit(0); }},
      {"chdir", [] { (void)!chdir("/"); }},
      {"leak", take_memory},
      {"limit",
       [] {
         const rlimit few{8, 8};
         (void)setrlimit(RLIMIT_NOFILE, &few);
       }},
      {"nap", [] { sleep(3); }},
      {"pin", start_thread},
      {"sleep",
       [] {
         for (;;) sleep(1);
       }},
      {"spin",
       [] {
         for (volatile bool spins = true; spins;) continue;
       }},
      {"throw", [] { throw std::runtime_error("no way"); }},
      {"write", [] { close(open("/dev/null", O_WRONLY | O_CLOEXEC)); }},
  };
  return all;
}

// Returns the name of the process, which in a trial is not that of a system's process.
std::string process_name() {
  std::ifstream file("/proc/self/comm");
  std::string name;
  std::getline(file, name);
  return name;
}

struct Unloading {
  ~Unloading() {
    if (std::string(ROGUE_UNLOADING) == "crash") raise(SIGSEGV);
    while (std::string(ROGUE_UNLOADING) == "sleep") sleep(1);
  }
} g_unloading;

/// Lets the robot stand, and does `deed` in the hook that `where` names: "start", "lap3".
class RogueAvoid final : public orca::Component {
 public:
  explicit RogueAvoid(orca::ComponentHost& host) : Component(host) {
    lap_on(laser_);
    deeds().at(ROGUE_CONSTRUCTOR)();
  }
  ~RogueAvoid() override { act("destructor"); }

 private:
  orca::Status configure() override { return act("configure"), orca::ok(); }
  orca::Status start() override {
    act("start");
    if (!*asks_ || !robot_.connected()) return orca::ok();
    const auto answer = robot_.query(robot_.loan(), std::chrono::seconds(1));
    return answer ? orca::ok() : orca::Status(answer.error());
  }
  void stop() override { act("stop"); }
  void suspend() override { act("suspend"); }
  void resume() override { act("resume"); }
  void save_state(orca::StateWriter& state) const override {
    act("save_state");
    state.write(std::string(static_cast<std::size_t>(*state_size_) << 20, 'x'), laps_);
  }
  orca::Status load_state(orca::StateReader& state) override {
    act("load_state");
    std::string filling;
    return state.read(filling, laps_);
  }

  orca::Outcome work() override {
    if (laser_.new_data_arrived()) (void)laser_.get_update();
    if (odometry_.new_data_arrived()) (void)odometry_.get_update();
    act("lap" + std::to_string(++laps_));
    act("each_lap");
    motion_.push(orca::full_stop());
    return orca::again();
  }

  void act(const std::string& here) const {
    if (here == *where_ && (process_->empty() || *process_ == process_name())) deeds().at (*deed_)();
  }

  orca::PushProxy<orca::idl::LaserRangeReadings> laser_{*this, "laser"};
  orca::PushProxy<orca::idl::Odometry> odometry_{*this, "odometry", {.optional = true}};
  orca::PushProxy<orca::idl::GoalPoint> goal_{*this, "goal", {.optional = true}};
  orca::PushProxy<orca::idl::RobotPose> localizer_{*this, "localizer", {.optional = true}};
  orca::PushServer<orca::idl::MotionCommand> motion_{*this, "motion"};
  orca::QueryProxy<orca::idl::Ask, orca::idl::Robot> robot_{*this, "robot", {.optional = true}};
  orca::Param<std::string> where_{*this, "where", ""};
  orca::Param<std::string> deed_{*this, "deed", "none"};
  orca::Param<std::string> process_{
      *this, "process", "", {.text = "The process in which it does that; empty: in any, as in a trial."}};
  orca::Param<bool> asks_{*this, "asks", true, {.text = "Whether start() asks the base and waits."}};
  orca::Param<std::int64_t> state_size_{
      *this, "state_size", 0, {.min = 0, .max = 1000, .text = "Of what it saves [MB]."}};
  std::int64_t laps_ = 0;
};

}  // namespace

ORCA_COMPONENT(RogueAvoid, "test.RogueAvoid")
ORCA_ALLOW_IN_VIRTUAL_TIME("sleep", "it is what is tested")
ORCA_ALLOW_IN_VIRTUAL_TIME("std::thread::_M_start_thread", "it is what is tested")
