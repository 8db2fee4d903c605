// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "orca/component.hpp"
#include "orca/idl/system.hpp"
#include "orca/navigation/path_driver.hpp"

namespace orca::planning {

/// The parameter that says how a planner gets on where nothing leads on, and the alarm RECOVERS of each time that it does.
///
/// Thread contract: as the component that owns it.
class Recoveries {
 public:
  explicit Recoveries(Component& owner, ComponentHost& host)
      : host_(host),
        names_(owner, "recoveries", usual(),
               {.text = "What it tries in turn where nothing leads on: back_off, clear, look_around, wait; "
                        "empty: it stands."}) {}

  /// Returns what is wrong with the parameter.
  [[nodiscard]] Status check() const {
    for (const std::string& name : *names_)
      if (!nav::recovery_of(name))
        return names_.refuse("\"" + name + "\" is none of back_off, clear, look_around, wait");
    return ok();
  }
  /// Returns the recoveries in their order. @pre  check() is ok.
  [[nodiscard]] nav::RecoveryOrder order() const {
    nav::RecoveryOrder order;
    for (const std::string& name : *names_)
      if (const auto recovery = nav::recovery_of(name)) order.push_back(*recovery);
    return order;
  }
  /// Takes note of the recovery that goes on; nothing: none does. Called each lap.
  void note(std::optional<nav::Recovery> now) {
    if (now == last_) return;
    last_ = now;
    host_.clear_alarm(kAlarm, now ? "it tries something else" : "it goes on by its own way");
    if (now)
      host_.raise_alarm(kAlarm, idl::ALARM_NOTICE, "nothing leads on: " + std::string(nav::name_of(*now)));
  }

 private:
  static constexpr const char* kAlarm = "RECOVERS";
  static std::vector<std::string> usual() {
    std::vector<std::string> names;
    for (const nav::Recovery recovery : nav::kUsualRecoveries) names.emplace_back(nav::name_of(recovery));
    return names;
  }

  ComponentHost& host_;
  Param<std::vector<std::string>> names_;
  std::optional<nav::Recovery> last_;
};

}  // namespace orca::planning
