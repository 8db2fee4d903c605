// SPDX-License-Identifier: LGPL-3.0-or-later
#include "orca/host/alarm.hpp"

#include "orca/base/log.hpp"

namespace orca::host {
namespace {

idl::AlarmSeverity severity_of(AlarmKind kind) {
  switch (kind) {
    case AlarmKind::hardware_fault: return idl::ALARM_CRITICAL;
    case AlarmKind::failed:
    case AlarmKind::stalled:
    case AlarmKind::foreign_thread:
    case AlarmKind::descriptors: return idl::ALARM_WARNING;
    default: return idl::ALARM_NOTICE;  // it was restored, or harms nobody yet
  }
}

}  // namespace

const char* to_string(AlarmKind kind) {
  switch (kind) {
    case AlarmKind::failed: return "FAILED";
    case AlarmKind::hardware_fault: return "HARDWARE_FAULT";
    case AlarmKind::stalled: return "STALLED";
    case AlarmKind::plugin_pinned: return "PLUGIN_PINNED";
    case AlarmKind::fork: return "FORK";
    case AlarmKind::foreign_thread: return "FOREIGN_THREAD";
    case AlarmKind::floating_point: return "FLOATING_POINT";
    case AlarmKind::locale: return "LOCALE";
    case AlarmKind::signal_mask: return "SIGNAL_MASK";
    case AlarmKind::signal_handler: return "SIGNAL_HANDLER";
    case AlarmKind::working_folder: return "WORKING_FOLDER";
    case AlarmKind::umask: return "UMASK";
    case AlarmKind::resource_limit: return "RESOURCE_LIMIT";
    case AlarmKind::descriptors: return "DESCRIPTORS";
  }
  return "?";
}

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

void log_alarm(const idl::Alarm& alarm, const std::string& log_name) {
  log::error(alarm.source().empty() ? log_name : alarm.source(),
             "alarm " + alarm.kind() + ": " + alarm.text());
}

std::string hook_text(Hook hook, const char* port) {
  return hook == Hook::handler ? std::string(port) + "()" : to_string(hook);
}

}  // namespace orca::host
