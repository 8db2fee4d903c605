// SPDX-License-Identifier: LGPL-3.0-or-later
#include "lap_trigger.hpp"

#include <algorithm>

#include "orca/patterns/endpoints/gathering.hpp"

namespace orca::host {

Status LapTrigger::choose(const Trigger& trigger, const PortSet& ports) {
  trigger_ = trigger;
  ports_.clear();
  for (const std::string& name : trigger.ports) {
    auto* port = dynamic_cast<PushClientEndpoint*>(ports.find(name));
    if (port == nullptr)
      return fail(Code::invalid_argument,
                  "its laps start on port \"" + name + "\", which is no PushProxy of it");
    ports_.push_back(port);
  }
  return ok();
}

void LapTrigger::begin(TimePoint now) {
  next_ = trigger_.waits_for_ports() ? saturating_add(now, trigger_.period) : now;
}

bool LapTrigger::is_due(TimePoint now) {
  if (trigger_.kind == Trigger::Kind::free_running) return true;
  return (trigger_.waits_for_ports() && has_objects()) || now >= next();
}

bool LapTrigger::has_objects() const {
  if (trigger_.kind == Trigger::Kind::on_stamps) return match(ports_, trigger_.within);
  return trigger_.kind == Trigger::Kind::on_all ? all_new(ports_) : any_new(ports_);
}

void LapTrigger::lap_begins(TimePoint now) {
  if (trigger_.kind == Trigger::Kind::period) next_ = std::max(saturating_add(next_, trigger_.period), now);
  if (trigger_.waits_for_ports()) next_ = saturating_add(now, trigger_.period);
}

TimePoint LapTrigger::next() const { return trigger_.period > Duration{0} ? next_ : kForever; }

// Returns the longest of the periods that the servers announce to which the trigger's ports are subscribed, or the shortest if
// one of them is enough for a lap. Each lap asks for it.
std::optional<Duration> LapTrigger::announced() const {
  std::optional<Duration> found;
  for (const PushClientEndpoint* port : ports_)
    for (const auto& edge : port->edges()) {
      if (!edge->subscribed()) continue;
      const UpdateGrant grant = edge->grant();
      if (grant.base_period <= Duration{0}) continue;
      const Duration before = found.value_or(grant.interval);
      found =
          trigger_.needs_all_ports() ? std::max(before, grant.interval) : std::min(before, grant.interval);
    }
  return found;
}

Duration LapTrigger::period() const {
  const std::optional<Duration> found = trigger_.waits_for_ports() ? announced() : std::nullopt;
  if (!found) return trigger_.period;
  return trigger_.period > Duration{0} ? std::min(*found, trigger_.period) : *found;
}

}  // namespace orca::host
