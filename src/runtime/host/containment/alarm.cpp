// SPDX-License-Identifier: LGPL-3.0-or-later
#include "orca/host/alarm.hpp"

#include <algorithm>
#include <cstddef>

#include "orca/base/log.hpp"
#include "orca/idl/generated/system.reflection.hpp"

namespace orca::host {
namespace {

constexpr auto& kNames = EnumReflection<AlarmKind>::names;

idl::AlarmSeverity severity_of(AlarmKind kind) {
  switch (kind) {
    case idl::HARDWARE_FAULT:
    case idl::MACHINE_LOST:
    case idl::ESTOP:
    case idl::CONTROL_LOST:
    case idl::GAVE_UP: return idl::ALARM_CRITICAL;
    case idl::FAILED:
    case idl::PROCESS_ENDED:
    case idl::STALLED:
    case idl::SWAP_UNDONE:
    case idl::CLOCKS_DIFFER:
    case idl::FOREIGN_THREAD:
    case idl::DESCRIPTORS: return idl::ALARM_WARNING;
    default: return idl::ALARM_NOTICE;  // it was restored, or harms nobody yet
  }
}

// A component weighs its own alarms. Those of the runtime are about faults of programs.
log::Level level_of(const idl::Alarm& alarm) {
  if (alarm.kind() != idl::OWN_KIND || alarm.severity() == idl::ALARM_CRITICAL) return log::Level::error;
  return alarm.severity() == idl::ALARM_WARNING ? log::Level::warning : log::Level::info;
}

}  // namespace

idl::Alarm make_alarm(AlarmKind kind, const std::string& component, const std::string& hook,
                      const std::string& text) {
  idl::Alarm alarm;
  alarm.severity(severity_of(kind));
  alarm.kind(kind);
  alarm.source() = component;
  alarm.hook() = hook;
  alarm.active(true);
  alarm.text() = text;
  return alarm;
}

idl::Alarm make_alarm(const std::string& own_kind, idl::AlarmSeverity severity, const std::string& component,
                      const std::string& text) {
  idl::Alarm alarm;
  alarm.severity(severity);
  alarm.kind(idl::OWN_KIND);
  alarm.own_kind() = own_kind;
  alarm.source() = component;
  alarm.active(true);
  alarm.text() = text;
  return alarm;
}

bool is_own_alarm_kind(std::string_view kind) {
  const auto fits = [](char c) { return (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_'; };
  return !kind.empty() && std::ranges::all_of(kind, fits) && std::ranges::find(kNames, kind) == kNames.end();
}

bool are_about_the_same(const idl::Alarm& one, const idl::Alarm& other) {
  return one.kind() == other.kind() && one.own_kind() == other.own_kind() && one.source() == other.source();
}

std::string alarm_text(const idl::Alarm& alarm) {
  return (alarm.source().empty() ? "" : alarm.source() + " ") + kind_text(alarm) + ": " + alarm.text();
}

void log_alarm(const idl::Alarm& alarm, const std::string& log_name) {
  log::write(level_of(alarm), alarm.source().empty() ? log_name : alarm.source(),
             "alarm " + kind_text(alarm) + ": " + alarm.text());
}

std::string hook_text(Hook hook, const char* port) {
  return hook == Hook::handler ? std::string(port) + "()" : to_string(hook);
}

}  // namespace orca::host
