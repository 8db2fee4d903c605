// SPDX-License-Identifier: GPL-3.0-or-later
#include <cstdint>
#include <stdexcept>
#include <string>

#include "orca/component.hpp"
#include "orca/idl/navigation.hpp"
#include "orca/idl/system.hpp"

namespace {

/// A component that logs each of its hooks, and misbehaves in them as `mode` says.
class Life final : public orca::Component {
 public:
  explicit Life(orca::ComponentHost& host) : Component(host) {}

 private:
  orca::Status configure() override {
    say("configure");
    lap_every(std::chrono::milliseconds(100));
    if (*mode_ == "configure laps without a pause") lap_every(orca::Duration{0});
    if (*mode_ == "configure waits") sleep(std::chrono::hours(1));
    return orca::ok();
  }

  orca::Status start() override {
    say("start");
    if (*mode_ == "start waits") goal_.get_update_wait();
    return *mode_ == "start fails" ? orca::Status(orca::fail(orca::Code::unavailable, "no start today"))
                                   : orca::ok();
  }

  orca::Outcome work() override {
    say("work " + number());
    if (*mode_ == "work fails once" && ++failures_ == 1) return orca::failed("not the first time");
    if (*mode_ == "work fails") return orca::failed("no work today");
    if (*mode_ == "work throws") throw std::runtime_error("no work today");
    if (*mode_ == "work makes a port") orca::PushServer<orca::idl::GoalPoint>(*this, "late");
    if (*mode_ == "work makes a parameter") orca::Param<bool>(*this, "late", false);
    if (*mode_ == "waits") goal_.get_update_wait();
    out_.push(out_.loan());
    return orca::again();
  }

  void stop() override {
    say("stop");
    if (*mode_ == "stop throws") throw std::runtime_error("no stop today");
  }
  void suspend() override { say("suspend"); }
  void resume() override { say("resume"); }

  orca::Status params_changed() override {
    say("params " + number());
    if (*low_ > *high_) return orca::fail(orca::Code::invalid_argument, "low is above high");
    if (*mode_ == "params throw") throw 7;
    return orca::ok();
  }

  orca::Status on_poke(const orca::ObjectPtr<orca::idl::GoalPoint>& goal) {
    say("poked " + std::string(goal->name()));
    return orca::ok();
  }

  orca::Result<orca::Loan<orca::idl::GoalPoint>> on_ask(const orca::ObjectPtr<orca::idl::Ask>& /*ask*/) {
    auto answer = orca::make_object<orca::idl::GoalPoint>();
    answer->name() = name();
    return answer;
  }

  [[nodiscard]] std::string number() const { return std::to_string(*low_) + "-" + std::to_string(*high_); }
  void say(const std::string& what) const { log_debug(what); }

  orca::PushServer<orca::idl::GoalPoint> out_{*this, "out"};
  orca::PushProxy<orca::idl::GoalPoint> goal_{*this, "in", {.optional = true}};
  orca::SendServer<orca::idl::GoalPoint> poke_{*this, "poke", &Life::on_poke};
  orca::QueryServer<orca::idl::Ask, orca::idl::GoalPoint> ask_{*this, "ask", &Life::on_ask};
  orca::Param<std::int64_t> low_{*this, "low", 1, {.min = 0, .max = 100}};
  orca::Param<std::int64_t> high_{*this, "high", 2, {.min = 0, .max = 100}};
  orca::Param<double> size_{*this, "size", 1.0, {.unit = "m", .min = 0.0, .max = 5.0}};
  orca::Param<std::string> label_{*this, "label", "a", {.fixed = true}};
  orca::Param<std::string> mode_{*this, "mode", ""};

  int failures_ = 0;
};

}  // namespace

ORCA_COMPONENT(Life, "test.Life")
