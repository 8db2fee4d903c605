// SPDX-License-Identifier: GPL-3.0-or-later
#include <string>

#include "orca/component.hpp"
#include "orca/idl/system.hpp"

namespace {

using orca::idl::Alarm;

/// Writes each alarm that it hears of to the log.
class AlarmListener final : public orca::Component {
 public:
  explicit AlarmListener(orca::ComponentHost& host) : Component(host) { lap_on(alarms_); }

 private:
  orca::Status configure() override {
    stay_active(true);
    return orca::ok();
  }

  orca::Outcome work() override {
    const auto alarm = alarms_.get_update_wait();
    log_info("hears " + orca::kind_text(*alarm) + " of " + alarm->source() + ": " + alarm->text());
    return orca::again();
  }

  orca::PushProxy<Alarm> alarms_{*this, "alarms", {.depth = 100}};
};

}  // namespace

ORCA_COMPONENT(AlarmListener, "test.AlarmListener")
