// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "orca/xml/diagnostics.hpp"

namespace orca::graph {

inline std::string in_quotes(std::string_view text) { return "\"" + std::string(text) + "\""; }

// Where the checks put what they find.
class Report {
 public:
  explicit Report(xml::Diagnostics& out) : out_(out) {}

  void error(const char* code, const xml::Position& position, std::string message);
  void warning(const char* code, const xml::Position& position, std::string message);
  void line(const xml::Position& position, std::string finished_line);

  // The nearest name, for the first 200 questions only: comparing each of 10,000 wrong names with 10,000
  // right ones would take minutes, and nobody reads that many hints.
  std::optional<std::string> nearest(std::string_view word, std::span<const std::string> candidates);
  // The same as the end of a message.
  std::string hint(std::string_view word, std::span<const std::string> candidates);

 private:
  xml::Diagnostics& out_;
  int hints_left_ = 200;
};

}  // namespace orca::graph
