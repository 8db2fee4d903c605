// SPDX-License-Identifier: GPL-3.0-or-later
#include <string>

#include "orca/component.hpp"
#include "orca/idl/hardware.hpp"
#include "orca/idl/navigation.hpp"
#include "orca/idl/system.hpp"
#include "throw_something.hpp"

namespace {

/// Throws `what` in the hook that `where` names, and does nothing else.
class Misbehaving final : public orca::Component {
 public:
  using Component::Component;
  ~Misbehaving() override { misbehave("destructor"); }

 private:
  orca::Status configure() override { return misbehave("configure"), orca::ok(); }
  orca::Status start() override { return misbehave("start"), orca::ok(); }
  orca::Outcome work() override {
    misbehave("work");
    sleep(std::chrono::milliseconds(50));
    return *where_ == "stop" ? orca::done() : orca::again();
  }
  void stop() override { misbehave("stop"); }

  orca::Status on_goal(const orca::ObjectPtr<orca::idl::GoalPoint>& /*goal*/) {
    return misbehave("send"), orca::ok();
  }
  orca::Result<orca::Loan<orca::idl::Robot>> on_ask(const orca::ObjectPtr<orca::idl::Ask>& /*ask*/) {
    misbehave("query");
    return orca::make_object<orca::idl::Robot>();
  }

  void misbehave(const std::string& here) const {
    if (here == *where_) orca::test::throw_something(*what_);
  }

  orca::SendServer<orca::idl::GoalPoint> goal_{*this, "goal", &Misbehaving::on_goal};
  orca::QueryServer<orca::idl::Ask, orca::idl::Robot> robot_{*this, "robot", &Misbehaving::on_ask};
  orca::Param<std::string> where_{*this, "where", "work", {.text = "A hook, send, query or destructor."}};
  orca::Param<std::string> what_{
      *this, "what", "exception", {.choices = {"exception", "int", "text", "nullptr", "object"}}};
};

}  // namespace

ORCA_COMPONENT(Misbehaving, "test.Misbehaving")
