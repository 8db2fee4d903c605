// SPDX-License-Identifier: LGPL-3.0-or-later
#include "lap_trigger.hpp"

#include <algorithm>

namespace orca::host {

Status LapTrigger::choose(const Trigger& trigger, const PortSet& ports) {
  trigger_ = trigger;
  port_ = nullptr;
  if (trigger_.kind != Trigger::Kind::on_port) return ok();
  port_ = dynamic_cast<PushClientEndpoint*>(ports.find(trigger_.port));
  if (port_ != nullptr) return ok();
  return fail(Code::invalid_argument,
              "its laps start on port \"" + trigger_.port + "\", which is no PushProxy of it");
}

bool LapTrigger::is_due(TimePoint now) const {
  switch (trigger_.kind) {
    case Trigger::Kind::free_running: return true;
    case Trigger::Kind::period: return now >= next_;
    case Trigger::Kind::on_port: return port_->has_new();
  }
  return false;
}

void LapTrigger::lap_begins(TimePoint now) {
  if (trigger_.kind == Trigger::Kind::period) next_ = std::max(saturating_add(next_, trigger_.period), now);
}

TimePoint LapTrigger::next() const { return trigger_.kind == Trigger::Kind::period ? next_ : kForever; }

}  // namespace orca::host
