// SPDX-License-Identifier: GPL-3.0-or-later
#include <string>

#include "orca/component.hpp"
#include "orca/idl/navigation.hpp"
#include "orca/idl/system.hpp"

namespace {

/// A component that uses another component from `from` to `until` after its start, then releases it for good.
class User final : public orca::Component {
 public:
  explicit User(orca::ComponentHost& host) : Component(host) {}

 private:
  orca::Status configure() override {
    stay_active(true);
    return orca::ok();
  }

  orca::Outcome work() override {
    sleep(orca::from_seconds(*from_));
    if (send_.connected()) send();
    if (query_.connected()) ask();
    push_.subscribe();
    sleep(orca::from_seconds(*until_ - *from_));
    push_.unsubscribe();
    return orca::done();
  }

  void send() {
    auto goal = send_.loan();
    goal->name() = "hello";
    const orca::Status sent = send_.send(std::move(goal));
    say("sent " + (sent.ok() ? "ok" : sent.error().text()));
  }

  void ask() {
    const auto answer = query_.query(query_.loan());
    say("answer " + (answer ? std::string((*answer)->name()) : answer.error().text()));
  }

  void say(const std::string& what) const { log_debug(name() + " " + what); }

  orca::PushProxy<orca::idl::GoalPoint> push_{*this, "push", {.optional = true, .manual = true}};
  orca::SendProxy<orca::idl::GoalPoint> send_{*this, "send", {.optional = true}};
  orca::QueryProxy<orca::idl::Ask, orca::idl::GoalPoint> query_{*this, "query", {.optional = true}};
  orca::Param<double> from_{*this, "from", 1.0, {.unit = "s"}};
  orca::Param<double> until_{*this, "until", 2.0, {.unit = "s"}};
};

}  // namespace

ORCA_COMPONENT(User, "test.User")
