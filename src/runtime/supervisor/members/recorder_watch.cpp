// SPDX-License-Identifier: LGPL-3.0-or-later
#include "beside.hpp"

#include "orca/base/log.hpp"
#include "orca/host/alarm.hpp"
#include "orca/idl/time.hpp"
#include "orca/supervisor/log_name.hpp"

namespace orca::supervisor {
namespace {

idl::Alarm alarm_of(const std::string& source, const std::string& text, bool is_active) {
  idl::Alarm alarm = host::make_alarm("RECORDING_LOST", idl::ALARM_WARNING, source, text);
  alarm.creation_time(to_time_value(steady_now()));
  alarm.stamp(alarm.creation_time());
  alarm.active(is_active);
  return alarm;
}

}  // namespace

void note_recorders(const Unrecorded& before, const Unrecorded& now, Ledger& ledger) {
  for (const auto& [source, text] : now) {
    if (before.contains(source)) continue;
    log::error(kLogName, "alarm RECORDING_LOST: " + text);
    ledger.note(alarm_of(source, text, true), "", "");
  }
  for (const auto& [source, text] : before)
    if (!now.contains(source)) ledger.note(alarm_of(source, "it is recorded again", false), "", "");
}

}  // namespace orca::supervisor
