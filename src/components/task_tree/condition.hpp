// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <functional>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "orca/base/result.hpp"

namespace orca::tasks {

/// A condition on what a running system says, as a task writes it:
///
///   alarm BATTERY_LOW             an alarm of this kind is active; "of base": one of this component
///   battery.charge below 0.3      a field of the last object at a port; likewise "above" and "is"
///   not ...                       the opposite
struct Condition {
  enum class Relation { alarm, below, above, is };
  Relation relation = Relation::alarm;
  bool negated = false;
  std::string subject;  ///< Kind of the alarm, or the port.
  std::string detail;   ///< Source of the alarm, empty: any; or the field.
  double limit = 0.0;   ///< For below and above.
  std::string value;    ///< For is.
  std::string text;     ///< As it was written.
};

/// A port whose objects conditions can look at.
struct Sight {
  std::string port;
  std::vector<std::string>
      fields;  ///< Names as field_names() returns them. Elements of lists need not be among them.
  /// The words that a field can be, of enumerations and fields that are true or false, by its name.
  std::map<std::string, std::vector<std::string>> words{};
};

/// Reads a condition.
/// @errors  invalid_argument with what was found and what can be written.
[[nodiscard]] Result<Condition> parse_condition(std::string_view text, std::span<const Sight> sights);

/// Says of a system what conditions ask for.
struct Outlook {
  /// Returns whether an alarm of that kind is active; source empty: of any component.
  std::function<bool(const std::string& kind, const std::string& source)> alarm;
  /// Returns a field of the last object at a port, as text; nothing if none has come, or it has no such field.
  std::function<std::optional<std::string>(const std::string& port, const std::string& field)> field;
};

/// Returns whether a condition holds. It does not as long as nothing has come that says so, negated or not.
[[nodiscard]] bool holds(const Condition& condition, const Outlook& outlook);

}  // namespace orca::tasks
