// SPDX-License-Identifier: LGPL-3.0-or-later
#include "alarm_relay.hpp"

#include "orca/idl/object_type.hpp"
#include "orca/supervisor/vocabulary.hpp"

namespace orca::supervisor {
namespace {

TellAlarm order_about(const idl::Alarm& alarm, const std::string& process) {
  TellAlarm order{process, {}};
  object_type<idl::Alarm>().serialize(&alarm, order.object);
  return order;
}

}  // namespace

void AlarmRelay::tell(const idl::Alarm& alarm, const std::string& process,
                      const std::string& reporter) const {
  for (Member* const member : members_)
    if (member->name() != reporter && member->phase() == Member::Phase::up)
      member->tell(order_about(alarm, process));
}

void AlarmRelay::tell_acknowledged(const host::KeptAlarm& alarm) const {
  for (Member* const member : members_)
    if (member->phase() == Member::Phase::up)
      member->tell(ForgetAlarm{kind_text(alarm.alarm), alarm.alarm.source(), alarm.process});
}

void AlarmRelay::brief(Member& member, const std::vector<host::KeptAlarm>& kept, bool knows_own) {
  for (const host::KeptAlarm& alarm : kept)
    if (!knows_own || alarm.process != member.name()) member.tell(order_about(alarm.alarm, alarm.process));
}

}  // namespace orca::supervisor
