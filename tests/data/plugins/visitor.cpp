// SPDX-License-Identifier: GPL-3.0-or-later
#include <cstdint>
#include <sstream>
#include <string>
#include <vector>

#include "orca/component.hpp"
#include "orca/idl/navigation.hpp"
#include "orca/idl/sensing.hpp"
#include "orca/idl/system.hpp"

namespace {

/// Uses another component by a plan, whose entries are a verb and a time [s] since its start: send, ask, listen, leave. It
/// logs what comes of each, and how long that took.
class Visitor final : public orca::Component {
 public:
  explicit Visitor(orca::ComponentHost& host) : Component(host) { lap_every(std::chrono::milliseconds(10)); }

 private:
  orca::Status configure() override {
    stay_active(true);
    return orca::ok();
  }

  orca::Status start() override {
    start_ = now();
    return orca::ok();
  }

  orca::Outcome work() override {
    if (awaits_ && push_.new_data_arrived()) {
      awaits_ = false;
      say("heard", orca::ok());
    }
    if (next_ == plan_->size()) return orca::again();
    std::istringstream entry((*plan_)[next_]);
    std::string verb;
    double at = 0.0;
    entry >> verb >> at;
    if (orca::to_seconds(now() - start_) < at) return orca::again();
    ++next_;
    since_ = now();
    act(verb);
    return orca::again();
  }

  void act(const std::string& verb) {
    if (verb == "send") say("sent", send_.send(send_.loan()));
    if (verb == "ask") {
      const auto answer = query_.query(query_.loan(), std::chrono::seconds(30));
      say("asked", answer ? orca::ok() : orca::Status(answer.error()));
    }
    if (verb == "leave") push_.unsubscribe();
    if (verb != "listen") return;
    awaits_ = true;
    push_.subscribe();
  }

  void say(const std::string& what, const orca::Status& status) const {
    log_info(what + " after " + std::to_string(orca::to_seconds(now() - since_)) +
             " s: " + (status.ok() ? "ok" : status.error().text()));
  }

  orca::PushProxy<orca::idl::Odometry> push_{*this, "push", {.optional = true, .manual = true}};
  orca::SendProxy<orca::idl::GoalPoint> send_{*this, "send", {.optional = true}};
  orca::QueryProxy<orca::idl::Ask, orca::idl::GoalPoint> query_{*this, "query", {.optional = true}};
  orca::Param<std::vector<std::string>> plan_{*this, "plan", {}};
  orca::TimePoint start_{};
  orca::TimePoint since_{};
  std::size_t next_ = 0;
  bool awaits_ = false;
};

}  // namespace

ORCA_COMPONENT(Visitor, "test.Visitor")
