// SPDX-License-Identifier: GPL-3.0-or-later
#include <cfenv>
#include <string>

#include "orca/component.hpp"
#include "orca/idl/navigation.hpp"

namespace {

/// Takes two arrivals, then does `deed`, and is done.
class Welcomer final : public orca::Component {
 public:
  explicit Welcomer(orca::ComponentHost& host) : Component(host) {}

 private:
  orca::Status configure() override {
    stay_active(true);
    return orca::ok();
  }

  orca::Outcome work() override {
    in_.get_update_wait();
    in_.get_update_wait();
    if (*deed_ == "raise") raise_some();
    if (*deed_ == "rounding") std::fesetround(FE_UPWARD);
    return *deed_ == "fail" ? orca::failed("nobody is at home") : orca::done();
  }

  void raise_some() {
    clear_alarm("HOUSE_FULL", "nothing was full");
    raise_alarm("HOUSE_FULL", orca::idl::ALARM_WARNING, "there is no chair left; bring one");
    raise_alarm("HOUSE_FULL", orca::idl::ALARM_WARNING, "there is still none");
    raise_alarm("ESTOP", orca::idl::ALARM_CRITICAL, "that is for the runtime to say");
    raise_alarm("full house", orca::idl::ALARM_NOTICE, "that is no word of capitals");
    clear_alarm("HOUSE_FULL", "a chair has come");
  }

  orca::PushProxy<orca::idl::Arrived> in_{*this, "in"};
  orca::Param<std::string> deed_{*this, "deed", "none", {.choices = {"none", "rounding", "fail", "raise"}}};
};

}  // namespace

ORCA_COMPONENT(Welcomer, "test.Welcomer")
