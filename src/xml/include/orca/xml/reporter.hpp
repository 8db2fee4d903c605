// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "orca/xml/diagnostics.hpp"

namespace orca::xml {

/// The place where the checks of a file report their findings and ask for the name that was probably meant.
///
/// Thread contract: not synchronised; one thread.
class Reporter {
 public:
  explicit Reporter(Diagnostics& out) : out_(out) {}
  virtual ~Reporter() = default;
  Reporter(const Reporter&) = delete;
  Reporter& operator=(const Reporter&) = delete;

  virtual void error(const char* code, const Position& position, std::string message);

  /// Returns the nearest name, for the first 200 questions only. Comparing each of 10,000 wrong names with
  /// 10,000 right ones would take minutes, and nobody reads that many hints.
  [[nodiscard]] std::optional<std::string> nearest(std::string_view word,
                                                   std::span<const std::string> candidates);
  /// Returns the same as the end of a message: `; did you mean "laser"?`, or nothing.
  [[nodiscard]] std::string hint(std::string_view word, std::span<const std::string> candidates);

  /// Returns false once the 200 questions have been asked.
  [[nodiscard]] bool has_hints() const { return hints_left_ > 0; }

  [[nodiscard]] Diagnostics& diagnostics() const { return out_; }

 private:
  Diagnostics& out_;
  int hints_left_ = 200;
};

}  // namespace orca::xml
