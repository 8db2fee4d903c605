// SPDX-License-Identifier: GPL-3.0-or-later
#include <limits>

#include "orca/component.hpp"
#include "orca/idl/motion.hpp"

namespace {

/// A behaviour that says one thing for a while, then another.
class VoiceOf final : public orca::Component {
 public:
  explicit VoiceOf(orca::ComponentHost& host) : Component(host) { lap_every(std::chrono::milliseconds(100)); }

 private:
  orca::Status start() override {
    motion_.start(lap_period());
    return orca::ok();
  }

  orca::Outcome work() override {
    ++laps_;
    say(orca::to_seconds(now()) < *until_ ? *first_ : *then_);
    return orca::again();
  }

  void say(const std::string& what) {
    if (what == "no_opinion" || (what == "slow" && laps_ % 10 == 0)) motion_.push(orca::dont_care());
    if (what == "full_stop") motion_.push(orca::full_stop());
    if (what == "drive") motion_.push(orca::head(0.0, 0.3));
    if (what == "full_stop_at_nan") motion_.push(at_nan(orca::full_stop()));
    if (what == "drive_at_250") motion_.push(orca::head(0.0, 250.0));
    if (what == "turn_by_90") motion_.push(orca::turn(90.0, 0.1));
    if (what == "drive_at_nan") motion_.push(at_nan(orca::head(0.0, 0.3)));
  }

  static orca::Loan<orca::idl::MotionCommand> at_nan(orca::Loan<orca::idl::MotionCommand> command) {
    command->speed(std::numeric_limits<double>::quiet_NaN());
    return command;
  }

  static std::vector<std::string> words() {
    return {"no_opinion",       "full_stop",    "drive",        "silence",   "slow",
            "full_stop_at_nan", "drive_at_nan", "drive_at_250", "turn_by_90"};
  }

  orca::PushServer<orca::idl::MotionCommand> motion_{*this, "motion"};
  orca::Param<std::string> first_{*this, "first", "no_opinion", {.choices = words()}};
  orca::Param<std::string> then_{*this, "then", "silence", {.choices = words()}};
  orca::Param<double> until_{*this, "until", 2.0, {.unit = "s", .min = 0.0}};
  int laps_ = 0;
};

}  // namespace

ORCA_COMPONENT(VoiceOf, "test.Voice")
