// SPDX-License-Identifier: LGPL-3.0-or-later
#include <chrono>
#include <cstddef>

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
    const std::size_t subscribers = alarms_.subscriber_count();
    const auto news = take_alarms();
    // A new subscriber first gets the open alarms, the new ones among them.
    for (const Alarm& alarm : subscribers > subscribers_ ? kept_alarms() : news) pass_on(alarm);
    subscribers_ = subscribers;
    return orca::again();
  }

  void stop() override { subscribers_ = 0; }

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

  std::size_t subscribers_ = 0;  // in the last lap
};

}  // namespace

ORCA_COMPONENT(AlarmCentral, "orca.AlarmCentral")
