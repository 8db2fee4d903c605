// SPDX-License-Identifier: LGPL-3.0-or-later
#include "orca/host/alarm.hpp"

#include <algorithm>
#include <array>
#include <cstddef>

#include "orca/base/log.hpp"

namespace orca::host {
namespace {

// By the number of the enumerator.
constexpr auto kNames = std::to_array<const char*>(
    {"FAILED",         "HARDWARE_FAULT", "STALLED", "PLUGIN_PINNED",     "FORK",
     "FOREIGN_THREAD", "FLOATING_POINT", "LOCALE",  "TERMINATE_HANDLER", "SIGNAL_MASK",
     "SIGNAL_HANDLER", "WORKING_FOLDER", "UMASK",   "RESOURCE_LIMIT",    "REDIRECTION",
     "DESCRIPTORS",    "PROCESS_ENDED",  "GAVE_UP", "MACHINE_LOST",      "ESTOP",
     "CONTROL_LOST",   "SWAP_UNDONE"});
static_assert(kNames.size() == static_cast<std::size_t>(AlarmKind::swap_undone) + 1);

idl::AlarmSeverity severity_of(AlarmKind kind) {
  switch (kind) {
    case AlarmKind::hardware_fault:
    case AlarmKind::machine_lost:
    case AlarmKind::estop:
    case AlarmKind::control_lost:
    case AlarmKind::gave_up: return idl::ALARM_CRITICAL;
    case AlarmKind::failed:
    case AlarmKind::process_ended:
    case AlarmKind::stalled:
    case AlarmKind::swap_undone:
    case AlarmKind::foreign_thread:
    case AlarmKind::descriptors: return idl::ALARM_WARNING;
    default: return idl::ALARM_NOTICE;  // it was restored, or harms nobody yet
  }
}

}  // namespace

const char* to_string(AlarmKind kind) { return kNames.at(static_cast<std::size_t>(kind)); }

idl::Alarm make_alarm(AlarmKind kind, const std::string& component, const std::string& hook,
                      const std::string& text) {
  idl::Alarm alarm;
  alarm.severity(severity_of(kind));
  alarm.kind() = to_string(kind);
  alarm.source() = component;
  alarm.hook() = hook;
  alarm.active(true);
  alarm.text() = text;
  return alarm;
}

idl::Alarm make_alarm(const std::string& kind, idl::AlarmSeverity severity, const std::string& component,
                      const std::string& text) {
  idl::Alarm alarm;
  alarm.severity(severity);
  alarm.kind() = kind;
  alarm.source() = component;
  alarm.active(true);
  alarm.text() = text;
  return alarm;
}

bool is_own_alarm_kind(std::string_view kind) {
  const auto fits = [](char c) { return (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_'; };
  return !kind.empty() && std::ranges::all_of(kind, fits) &&
         std::ranges::find(kNames, kind, [](const char* name) { return std::string_view(name); }) ==
             kNames.end();
}

std::string alarm_text(const idl::Alarm& alarm) {
  return (alarm.source().empty() ? "" : alarm.source() + " ") + alarm.kind() + ": " + alarm.text();
}

void log_alarm(const idl::Alarm& alarm, const std::string& log_name) {
  log::error(alarm.source().empty() ? log_name : alarm.source(),
             "alarm " + alarm.kind() + ": " + alarm.text());
}

std::string hook_text(Hook hook, const char* port) {
  return hook == Hook::handler ? std::string(port) + "()" : to_string(hook);
}

}  // namespace orca::host
