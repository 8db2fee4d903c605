// SPDX-License-Identifier: GPL-3.0-or-later
#include <stdexcept>
#include <string>

#include "orca/component.hpp"
#include "orca/idl/navigation.hpp"
#include "orca/idl/system.hpp"
#include "orca/idl/time.hpp"

namespace {

/// Passes on what it hears, one object each lap, and logs how old each is when it hears it and when it has given it out.
class Relay final : public orca::Component {
 public:
  explicit Relay(orca::ComponentHost& host) : Component(host) {}

 private:
  orca::Status configure() override {
    stay_active(true);
    if (*mode_ != "waits") lap_on("in");
    return orca::ok();
  }

  orca::Outcome work() override {
    const auto heard = *mode_ == "waits" ? in_.get_update_wait() : in_.get_update();
    say("hears", *heard);
    if (*mode_ == "throws") throw std::runtime_error("it computes for nothing");
    if (*mode_ == "asks") {
      const auto answer = ask_.query(ask_.loan());
      say(answer ? "was answered" : "was not answered", *heard);
    }
    if (*mode_ == "sends") {
      auto poke = poke_.loan();
      poke->name() = "by " + name();
      (void)poke_.send(std::move(poke));
      say("sent", *heard);
    }
    if (*mode_ != "mute") {
      out_.push(*heard);
      say("gives", *heard);
    }
    return orca::again();
  }

  void say(const std::string& what, const orca::idl::Arrived& object) const {
    const orca::Duration age = now() - orca::to_time_point(object.stamp());
    log_debug(name() + " " + what + " " + std::to_string(static_cast<int>(object.x())) + " after " +
              std::to_string(age / std::chrono::milliseconds(1)) + " ms");
  }

  orca::PushProxy<orca::idl::Arrived> in_{*this, "in"};
  orca::PushServer<orca::idl::Arrived> out_{*this, "out"};
  orca::SendProxy<orca::idl::GoalPoint> poke_{*this, "poke", {.optional = true}};
  orca::QueryProxy<orca::idl::Ask, orca::idl::GoalPoint> ask_{*this, "ask", {.optional = true}};
  orca::Param<std::string> mode_{
      *this, "mode", "laps", {.choices = {"laps", "waits", "mute", "sends", "asks", "throws"}}};
};

}  // namespace

ORCA_COMPONENT(Relay, "test.Relay")
