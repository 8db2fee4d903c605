// SPDX-License-Identifier: LGPL-3.0-or-later
#include "recollection.hpp"

#include <algorithm>
#include <variant>

#include "orca/idl/object_type.hpp"

namespace orca::supervisor {

bool Recollection::note_state(const Report& report) {
  if (const auto* built = std::get_if<Built>(&report)) return built_ = *built, true;
  if (const auto* change = std::get_if<StateChange>(&report))
    return states_[change->component] = *change, true;
  if (const auto* code = std::get_if<ExchangedCode>(&report)) {
    params_.erase(code->component);  // it says what they are now
    return code_[code->component] = *code, true;
  }
  if (const auto* kept = std::get_if<StateKept>(&report)) return kept_[kept->component] = *kept, true;
  if (const auto* rest = std::get_if<RestChange>(&report)) return at_rest_ = rest->at_rest, true;
  return false;
}

void Recollection::note_told(const Report& report) {
  const auto* const told = std::get_if<AlarmReport>(&report);
  idl::Alarm alarm;
  if (told != nullptr && object_type<idl::Alarm>().deserialize(told->object, &alarm).ok())
    alarms_.take(alarm, process_);
}

void Recollection::forget_alarm(const ForgetAlarm& forgotten) {
  const auto kept = std::ranges::find_if(alarms_.kept(), [&](const host::KeptAlarm& one) {
    return one.process == forgotten.process && kind_text(one.alarm) == forgotten.kind &&
           one.alarm.source() == forgotten.source;
  });
  if (kept != alarms_.kept().end()) (void)alarms_.acknowledge(kept->number);
}

void Recollection::note_params(const std::string& component, const Pairs& values) {
  for (const auto& [param, value] : values) params_[component][param] = value;
}

void Recollection::forget_component(const std::string& component) {
  states_.erase(component);
  params_.erase(component);
  code_.erase(component);
  kept_.erase(component);
}

std::vector<Report> Recollection::reports() const {
  std::vector<Report> all;
  if (built_) all.emplace_back(*built_);
  for (const auto& [component, state] : states_) all.emplace_back(state);
  for (const auto& [component, code] : code_) all.emplace_back(code);
  for (const auto& [component, kept] : kept_) all.emplace_back(kept);
  all.emplace_back(RestChange{at_rest_});
  Standing standing;
  standing.motors_held = motors_held_;
  for (const host::KeptAlarm& kept : alarms_.kept())
    object_type<idl::Alarm>().serialize(
        &kept.alarm, standing.alarms.emplace_back(kept.process, std::vector<std::byte>{}).second);
  for (const auto& [component, values] : params_)
    standing.params.emplace_back(component, Pairs(values.begin(), values.end()));
  all.emplace_back(std::move(standing));
  return all;
}

}  // namespace orca::supervisor
