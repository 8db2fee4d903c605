// SPDX-License-Identifier: LGPL-3.0-or-later
#include "damaged_edges.hpp"

#include <algorithm>
#include <utility>

#include "orca/base/log.hpp"
#include "orca/base/text.hpp"
#include "orca/host/alarm.hpp"

namespace orca::host {
namespace {

constexpr const char* kAlarm = "LINK_CUT";

}  // namespace

void DamagedEdges::note(const std::string& edge, const std::string& component, const Error& reason) {
  {
    const MutexLock lock(mutex_);
    components_[edge] = component;
  }
  reporter_().raise(make_alarm(
      kAlarm, idl::ALARM_CRITICAL, component,
      "the memory of the connection " + in_quotes(edge) + " was damaged (" + reason.message +
          "), so the connection was cut: one of its two processes writes where it must not. If it stays cut, "
          "orcactl restart one of them"));
  listener_.edge_damaged(edge);
}

void DamagedEdges::note_renewal(const std::string& edge) {
  std::string component;
  {
    const MutexLock lock(mutex_);
    const auto damaged = components_.find(edge);
    if (damaged == components_.end()) return;
    component = damaged->second;
    components_.erase(damaged);
    if (std::ranges::any_of(components_, [&](const auto& other) { return other.second == component; }))
      return;
  }
  const std::string text = "its damaged connections have new memory";
  log::info(component, std::string("alarm ") + kAlarm + " is over: " + text);
  idl::Alarm over = make_alarm(kAlarm, idl::ALARM_CRITICAL, component, text);
  over.active(false);
  reporter_().note(std::move(over));
}

}  // namespace orca::host
