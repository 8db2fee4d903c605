// SPDX-License-Identifier: LGPL-3.0-or-later
#include "members/recorder_watch.hpp"

#include <utility>

#include "orca/base/log.hpp"
#include "orca/host/alarm.hpp"
#include "orca/idl/time.hpp"
#include "orca/supervisor/log_name.hpp"

namespace orca::supervisor {
namespace {

constexpr Duration kInterval = 1s;

idl::Alarm alarm_of(const std::string& source, const std::string& text, bool is_active) {
  idl::Alarm alarm = host::make_alarm("RECORDING_LOST", idl::ALARM_WARNING, source, text);
  alarm.creation_time(to_time_value(steady_now()));
  alarm.stamp(alarm.creation_time());
  alarm.active(is_active);
  return alarm;
}

}  // namespace

void look_at_recorders(RecorderWatch& watch,
                       const std::function<std::map<std::string, std::string>(bool)>& look, bool has_come_up,
                       Moment now, Ledger& ledger) {
  if (!look || now - watch.looked < kInterval) return;
  watch.looked = now;
  const auto before = std::exchange(watch.wrong, look(has_come_up));
  for (const auto& [source, text] : watch.wrong) {
    if (before.contains(source)) continue;
    log::error(kLogName, "alarm RECORDING_LOST: " + text);
    ledger.note(alarm_of(source, text, true), "", "");
  }
  for (const auto& [source, text] : before)
    if (!watch.wrong.contains(source)) ledger.note(alarm_of(source, "it is recorded again", false), "", "");
}

}  // namespace orca::supervisor
