// SPDX-License-Identifier: LGPL-3.0-or-later
#include <chrono>
#include <utility>

#include "orca/component.hpp"
#include "orca/idl/system.hpp"

namespace {

using orca::idl::Alarm;

/// A component that passes on the alarms of the whole system: those of all processes, and those of the supervisor.
class AlarmCentral final : public orca::Component {
 public:
  explicit AlarmCentral(orca::ComponentHost& host) : Component(host) {
    lap_every(std::chrono::milliseconds(50));
  }

 private:
  orca::Status configure() override {
    stay_active(true);
    return orca::ok();
  }

  orca::Outcome work() override {
    const bool is_new = std::exchange(was_stopped_, false);  // to those who have stayed, too
    const bool somebody_is_new = alarms_.take_new_subscribers() || is_new;
    const auto news = take_alarms();
    // A new subscriber first gets the open alarms, the new ones among them.
    for (const Alarm& alarm : somebody_is_new ? kept_alarms() : news) pass_on(alarm);
    return orca::again();
  }

  void stop() override { was_stopped_ = true; }

  void pass_on(const Alarm& alarm) {
    if (alarms_.subscriber_count() == 0) return;
    note_cause(alarm);  // of its mission
    auto copy = alarms_.loan();
    *copy = alarm;
    alarms_.push(std::move(copy));
  }

  orca::PushServer<Alarm> alarms_{*this,
                                  "AlarmPush",
                                  {.text = "Each alarm that is raised or cleared anywhere in the system. To "
                                           "a new subscriber, and with it to all, "
                                           "first those that nobody has acknowledged yet."}};
  bool was_stopped_ = false;
};

}  // namespace

ORCA_COMPONENT(AlarmCentral, "orca.AlarmCentral")
