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
    if (*deed_ == "rounding") std::fesetround(FE_UPWARD);
    return *deed_ == "fail" ? orca::failed("nobody is at home") : orca::done();
  }

  orca::PushProxy<orca::idl::Arrived> in_{*this, "in"};
  orca::Param<std::string> deed_{*this, "deed", "none", {.choices = {"none", "rounding", "fail"}}};
};

}  // namespace

ORCA_COMPONENT(Welcomer, "test.Welcomer")
