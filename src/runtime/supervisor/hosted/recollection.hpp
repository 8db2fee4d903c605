// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "orca/host/alarm_store.hpp"
#include "orca/supervisor/vocabulary.hpp"

namespace orca::supervisor {

/// What a host process and its supervisor have told each other, as far as the next supervisor must know it: how the
/// components are, which alarms are kept, whether the motors are held, which parameters were changed, which code was
/// exchanged.
///
/// Thread contract: not synchronised.
class Recollection {
 public:
  /// @param process  name of this one.
  explicit Recollection(std::string process) : process_(std::move(process)) {}

  /// Notes a report that tells how something is from now on. Returns whether it is one.
  bool note_state(const Report& report);
  /// Notes a report that a supervisor has been told.
  void note_told(const Report& report);

  /// Notes an alarm of another process, or of the supervisor.
  void note_alarm(const idl::Alarm& alarm, const std::string& process) { alarms_.take(alarm, process); }
  void forget_alarm(const ForgetAlarm& alarm);
  void note_held(bool held) { motors_held_ = held; }
  void note_params(const std::string& component, const Pairs& values);
  /// Forgets a component that has gone: a supervisor that comes later does not know it.
  void forget_component(const std::string& component);

  /// Returns the reports from which a new supervisor learns all this.
  [[nodiscard]] std::vector<Report> reports() const;

 private:
  const std::string process_;
  std::optional<Built> built_;
  std::map<std::string, StateChange> states_;  // by component
  bool at_rest_ = true;
  host::AlarmStore alarms_;
  bool motors_held_ = false;
  std::map<std::string, std::map<std::string, std::string>> params_;  // by component
  std::map<std::string, ExchangedCode> code_;                         // by component
  std::map<std::string, StateKept> kept_;                             // by component
};

}  // namespace orca::supervisor
