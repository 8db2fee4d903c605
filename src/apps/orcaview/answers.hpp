// SPDX-License-Identifier: GPL-3.0-or-later
// Additional permission: LICENSES/Orca-plugin-exception.txt
#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "orca/base/result.hpp"
#include "orca/supervisor/control.hpp"

namespace orca::view {

/// Returns a record as a JSON object: numbers and flags are such, a missing number is null.
[[nodiscard]] nlohmann::json json_of(const supervisor::Record& record);

/// Reads a message. What is nested more than 16 deep is none: each level takes the stack of whoever copies it.
/// @return  a discarded value if it is no JSON.
[[nodiscard]] nlohmann::json read_json(const std::string& text);

/// Returns the text of a message. Bytes that are no UTF-8 are replaced.
[[nodiscard]] std::string text_of(const nlohmann::json& message);

/// Collects the answer to a question of a page.
class AnswerInParts {
 public:
  explicit AnswerInParts(std::uint64_t id);

  void take(const supervisor::ControlAnswer& answer);
  /// Returns the whole answer.
  [[nodiscard]] nlohmann::json finish(const Status& outcome);

 private:
  nlohmann::json answer_;
  std::string text_;
};

}  // namespace orca::view
