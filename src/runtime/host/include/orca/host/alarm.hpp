// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <functional>
#include <string>
#include <string_view>

#include "orca/base/hook.hpp"
#include "orca/idl/system.hpp"

namespace orca::host {

using idl::AlarmKind;

/// A function that takes alarms as they are raised.
///
/// Thread contract: called from any strand or thread, also from several at once.
using AlarmSink = std::function<void(const idl::Alarm&)>;

/// Makes an alarm that is raised now. The caller fills in its times, mission and cause where they are known.
/// @param component  name as in the graph; empty: not known to be a single component.
/// @param hook       as returned by to_string(Hook) or hook_text(); empty: outside any hook.
[[nodiscard]] idl::Alarm make_alarm(AlarmKind kind, const std::string& component, const std::string& hook,
                                    const std::string& text);

/// Makes an alarm of a component's own, without times, mission and cause.
[[nodiscard]] idl::Alarm make_alarm(const std::string& own_kind, idl::AlarmSeverity severity,
                                    const std::string& component, const std::string& text);
/// Returns whether a component may raise an alarm of that kind: a word of capitals, digits and '_' that is none of the runtime's.
[[nodiscard]] bool is_own_alarm_kind(std::string_view kind);

/// Returns whether two alarms report one thing: kind and source are the same.
[[nodiscard]] bool are_about_the_same(const idl::Alarm& one, const idl::Alarm& other);

/// Returns an alarm for people: "avoid FAILED: work() threw 7".
[[nodiscard]] std::string alarm_text(const idl::Alarm& alarm);

/// Writes an alarm to the log, under the name of its component: "alarm SIGNAL_MASK: work() has blocked
/// SIGUSR1".
/// @param log_name  the name for an alarm without a component.
void log_alarm(const idl::Alarm& alarm, const std::string& log_name);

/// Returns the hook for people, to stand before a verb: "work()"; for a handler, the name of its port:
/// "goal()".
[[nodiscard]] std::string hook_text(Hook hook, const char* port);

}  // namespace orca::host
