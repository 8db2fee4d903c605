// SPDX-License-Identifier: LGPL-3.0-or-later
#include "control/alarm_desk.hpp"

#include <charconv>
#include <cstdint>

#include "orca/base/text.hpp"
#include "orca/idl/time.hpp"

namespace orca::supervisor {
namespace {

const char* name_of(idl::AlarmSeverity severity) {
  switch (severity) {
    case idl::ALARM_NOTICE: return "notice";
    case idl::ALARM_WARNING: return "warning";
    case idl::ALARM_CRITICAL: return "critical";
  }
  return "?";
}

Record record_of(const host::KeptAlarm& kept, TimePoint start) {
  const idl::Alarm& alarm = kept.alarm;
  return {{"number", kept.number},
          {"time", to_seconds(to_time_point(alarm.stamp()) - start), 3},
          {"severity", name_of(alarm.severity())},
          {"kind", kind_text(alarm)},
          {"source", alarm.source()},
          {"process", kept.process},
          {"times", kept.times},
          {"active", alarm.active()},
          {"mission", alarm.mission()},
          {"text", alarm.text()}};
}

void acknowledge(const std::string& word, Ledger& ledger, Reply& reply) {
  std::uint64_t number = 0;
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), number);
  if (error != std::errc{} || end != word.data() + word.size())
    return reply.refuse(
        fail(Code::invalid_argument, in_quotes(word) + " is no number of an alarm; see: orcactl alarms"));
  if (const Status taken = ledger.acknowledge(number); !taken.ok()) reply.refuse(taken.error());
}

void acknowledge_all(Ledger& ledger, Reply& reply) {
  std::vector<std::uint64_t> numbers;
  for (const host::KeptAlarm& kept : ledger.alarms()) numbers.push_back(kept.number);
  for (const std::uint64_t number : numbers)
    if (const Status taken = ledger.acknowledge(number); !taken.ok()) reply.refuse(taken.error());
}

}  // namespace

void handle_alarms(const std::vector<std::string>& words, Ledger& ledger, Reply& reply) {
  if (words.empty()) {
    for (const host::KeptAlarm& kept : ledger.alarms()) reply.add(record_of(kept, ledger.start()));
    return;
  }
  if (words[0] != "ack" || words.size() < 2)
    return reply.refuse(fail(Code::invalid_argument, "alarms takes nothing, ack N, or ack all"));
  for (std::size_t i = 1; i < words.size(); ++i) {
    if (words[i] != "all") {
      acknowledge(words[i], ledger, reply);
      continue;
    }
    acknowledge_all(ledger, reply);
  }
}

}  // namespace orca::supervisor
