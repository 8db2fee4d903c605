// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <functional>
#include <string>
#include <string_view>

#include "orca/base/hook.hpp"
#include "orca/idl/system.hpp"

namespace orca::host {

/// The kinds of alarm that the runtime itself raises.
enum class AlarmKind {
  failed,          ///< A component has failed: an exception, an error, or WORK_FAILED.
  hardware_fault,  ///< A hardware container is in the state Fault.
  stalled,         ///< A component computes or sleeps without waiting for anything of Orca.
  plugin_pinned,   ///< A plugin stays in memory although nothing uses it.
  fork,            ///< A component called fork(); the copy was ended.
  foreign_thread,  ///< A thread that runs no component called a port; the call was refused.
  floating_point,  ///< The following are changes of state that all components share.
  locale,
  terminate_handler,
  signal_mask,
  signal_handler,
  working_folder,
  umask,
  resource_limit,
  redirection,    ///< Of stdin, stdout or stderr.
  descriptors,    ///< Descriptors were left open, or none are left.
  process_ended,  ///< A host process has ended although nobody asked it to, or hangs and was ended.
  gave_up,        ///< Processes were restarted too often; the run ends.
  machine_lost,   ///< Another machine of the system is silent, or could not start again.
  estop,  ///< Motors are held: an operator has stopped all, the process of some was lost, or the base wants a person.
  control_lost,  ///< Nobody can reach this system with orcactl any more, not even to stop it.
  swap_undone  ///< A new version of a component failed soon after it had taken over, and the old one is back.
};

/// Returns the kind in capitals, as in idl::Alarm: "SIGNAL_MASK".
[[nodiscard]] const char* to_string(AlarmKind kind);

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
[[nodiscard]] idl::Alarm make_alarm(const std::string& kind, idl::AlarmSeverity severity,
                                    const std::string& component, const std::string& text);
/// Returns whether a component may raise an alarm of that kind: a word of capitals, digits and '_' that is none of the runtime's.
[[nodiscard]] bool is_own_alarm_kind(std::string_view kind);

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
