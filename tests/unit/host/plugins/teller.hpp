// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// A component in several versions, made of this class with different definitions:
//   TELLER_VERSION    number that it says with each lap
//   TELLER_STATE      version of its state; 2 has one value more than 1; 0: it keeps nothing
//   TELLER_FAULT      0: none, else where it fails (see below)
//   TELLER_TYPE      its type
//   TELLER_INPUT     the name of its input
//   TELLER_TONE       it has a parameter more
//   TELLER_HEIR       it goes on from the state of test.Teller and test.OtherTeller, too
#include <algorithm>
#include <chrono>
#include <csignal>
#include <cstdint>
#include <cstdlib>
#include <fstream>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include "orca/component.hpp"
#include "orca/idl/motion.hpp"
#include "orca/idl/navigation.hpp"

#ifndef TELLER_STATE
#define TELLER_STATE 1
#endif
#ifndef TELLER_FAULT
#define TELLER_FAULT 0
#endif
#ifndef TELLER_TYPE
#define TELLER_TYPE "test.Teller"
#endif
#ifndef TELLER_INPUT
#define TELLER_INPUT "in"
#endif

namespace {

enum Fault {
  kNone,
  kConstructor,
  kConfigure,
  kStart,
  kLoadThrows,
  kFirstLap,
  kThirdLap,
  kHandler,
  kSaveThrows,
  kLoadReadsTooLittle,
  kLoadReadsOther,
  kConstructorCrashes,
  kLapCrashes,
  kLapHangs,
  kLapEats,
  kLapsSlow,
  kConstructorInStill,
  kLapInStill,
  kLateLapCrashes,
  kDestructorCrashes
};

/// What no exception handler can catch.
[[noreturn, gnu::noinline]] void crash() {
  std::raise(SIGSEGV);
  std::abort();
}

[[gnu::noinline]] void eat() {
  for (std::vector<std::unique_ptr<std::vector<char>>> all;;)
    all.push_back(std::make_unique<std::vector<char>>(std::size_t{1} << 24, 'x'));
}

/// Returns whether this is the process "still" of a system, and not one where graphs are checked or new code is tried.
bool is_in_still() {
  std::ifstream name("/proc/self/comm");
  std::string here;
  std::getline(name, here);
  return here == "still";
}

/// Counts what arrives, and says its version and the count each time.
class Teller final : public orca::Component {
 public:
  explicit Teller(orca::ComponentHost& host) : Component(host) {
    lap_on(in_);
    if (TELLER_FAULT == kConstructorCrashes) crash();
    if (TELLER_FAULT == kConstructor) throw std::runtime_error("no teller today");
    if (TELLER_FAULT == kConstructorInStill && is_in_still()) throw std::runtime_error("no teller in still");
  }

  ~Teller() override {
    if (TELLER_FAULT == kDestructorCrashes) crash();
  }

 private:
  orca::Status configure() override {
    if (TELLER_FAULT == kConfigure) return step_.refuse("is not liked today");
    return in_.connected() ? orca::ok() : orca::fail(orca::Code::failed_precondition, "nothing to count");
  }
  orca::Status start() override {
    if (TELLER_FAULT == kStart) throw std::runtime_error("no start today");
    if (*tells_) log_debug("start " + version());
    if (*forgets_) count_ = last_poke_ = 0;
    return orca::ok();
  }
  void stop() override { log_debug("stop " + version()); }
  void suspend() override { log_debug("suspend " + version()); }
  void resume() override { log_debug("resume " + version()); }

  orca::Outcome work() override {
    ++laps_;
    fail_in_lap();
    while (in_.new_data_arrived()) {
      const auto object = in_.get_update();
      if (last_ != 0 && object->seq() != last_ + 1)
        log_debug("gap " + std::to_string(last_) + ":" + std::to_string(object->seq()));
      last_ = object->seq();
      count_ += *step_;
      say();
    }
    if (TELLER_FAULT == kLapsSlow) wait_until([] { return false; }, std::chrono::milliseconds(15));
    return orca::again();
  }

  void fail_in_lap() const {
    if (TELLER_FAULT == kFirstLap || (TELLER_FAULT == kThirdLap && laps_ == 3))
      throw std::runtime_error("no lap today");
    if (TELLER_FAULT == kLapInStill && laps_ == 3 && is_in_still())
      throw std::runtime_error("no lap in still");
    if (TELLER_FAULT == kLapCrashes && laps_ == 3) crash();
    if (TELLER_FAULT == kLateLapCrashes && laps_ == 100) crash();  // later than a trial lasts
    if (TELLER_FAULT == kLapEats && laps_ == 3) eat();
    for (volatile bool hangs = TELLER_FAULT == kLapHangs && laps_ == 3; hangs;) continue;
  }

  void say() {
    orca::Loan<orca::idl::GoalPoint> said = out_.loan();
    said->name() = version() + ":" + std::to_string(count_);
    out_.push(std::move(said));
  }

  orca::Status on_poke(const orca::ObjectPtr<orca::idl::GoalPoint>& poke) {
    if (TELLER_FAULT == kHandler) throw std::runtime_error("no poke today");
    const auto number = std::stoll(std::string(poke->name()));
    if (number != last_poke_ + 1)
      log_debug("poke " + std::to_string(number) + " after " + std::to_string(last_poke_));
    last_poke_ = number;
    return orca::ok();
  }

  [[nodiscard]] std::string version() const { return std::to_string(TELLER_VERSION); }

  // --- State
  void save_state(orca::StateWriter& state) const override {
    if (TELLER_STATE == 0) return;
    if (TELLER_FAULT == kSaveThrows) throw std::runtime_error("no state today");
    state.write(count_, last_, last_poke_);
    if (TELLER_STATE == 2) state.write(std::string("two"));
  }
  orca::Status load_state(orca::StateReader& state) override {
    if (TELLER_FAULT == kLoadThrows) throw std::runtime_error("no state for me");
    if (TELLER_FAULT == kLoadReadsTooLittle) return state.read(count_);
    if (TELLER_FAULT == kLoadReadsOther) return state.read(name_);
    if (const orca::Status read = state.read(count_, last_, last_poke_); !read.ok()) return read;
    return state.tag().version == 2 ? state.read(name_) : orca::ok();
  }
  [[nodiscard]] std::uint32_t state_version() const override { return std::max(TELLER_STATE, 1); }
  [[nodiscard]] std::vector<orca::StateTag> accepted_states() const override {
#ifdef TELLER_HEIR
    return {{"test.Teller", 1}, { "test.OtherTeller", 1 }};
#else
    return TELLER_STATE == 2 ? std::vector<orca::StateTag>{{TELLER_TYPE, 1}} : std::vector<orca::StateTag>{};
#endif
  }

  orca::PushProxy<orca::idl::MotionCommand> in_{*this, TELLER_INPUT};
  orca::PushServer<orca::idl::GoalPoint> out_{*this, "out"};
  orca::SendServer<orca::idl::GoalPoint> poke_{*this, "poke", &Teller::on_poke};
  orca::Param<bool> tells_{*this, "tells", true, {.text = "Whether to log its start."}};
  orca::Param<bool> forgets_{*this, "forgets", false, {.text = "Whether start() begins to count anew."}};
  orca::Param<std::int64_t> step_{*this, "step", 1, {.min = 1, .max = 10}};
#ifdef TELLER_TONE
  orca::Param<std::string> tone_{*this, "tone", "flat", {.choices = { "flat", "sharp" } }};
#endif

  std::int64_t count_ = 0;
  std::uint64_t last_ = 0;
  std::int64_t last_poke_ = 0;
  std::int64_t laps_ = 0;
  std::string name_;
};

}  // namespace
