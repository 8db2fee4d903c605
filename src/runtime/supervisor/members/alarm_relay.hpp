// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "member.hpp"
#include "orca/host/alarm_store.hpp"
#include "orca/idl/system.hpp"

namespace orca::supervisor {

/// Tells the host processes of the alarms of all others and of the supervisor, for components that pass them on.
///
/// Thread contract: the supervisor's thread.
class AlarmRelay {
 public:
  /// @param members  outlives the object.
  explicit AlarmRelay(const std::vector<Member*>& members) : members_(members) {}

  /// Passes on an alarm.
  /// @param process   that the alarm is about; empty: not one alone.
  /// @param reporter  the process that has reported it, and knows of it; empty: the supervisor.
  void tell(const idl::Alarm& alarm, const std::string& process, const std::string& reporter) const;
  /// Passes on that an alarm was acknowledged.
  void tell_acknowledged(const host::KeptAlarm& alarm) const;
  /// Tells a process that has just come up what is kept.
  /// @param knows_own  whether it has raised its own alarms itself; otherwise a predecessor has.
  static void brief(Member& member, const std::vector<host::KeptAlarm>& kept, bool knows_own);

 private:
  const std::vector<Member*>& members_;
};

}  // namespace orca::supervisor
