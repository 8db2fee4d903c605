// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <algorithm>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <string_view>

#include "orca/xml/diagnostics.hpp"

namespace orca::graph {

inline std::string in_quotes(std::string_view text) { return "\"" + std::string(text) + "\""; }

// Where the checks put what they find.
class Report {
 public:
  // @param strict  warnings are errors
  explicit Report(xml::Diagnostics& out, bool strict = false) : out_(out), strict_(strict) {}

  // The file may be part of the graph several times: what is wrong in it is told once, not for each copy.
  void share(const std::string& file) { shared_files_.insert(file); }

  void error(const char* code, const xml::Position& position, std::string message);
  void warning(const char* code, const xml::Position& position, std::string message);
  // A context that is no good name is reported: what is wrong with names in it is not told again.
  void tolerate(const std::string& context) { bad_contexts_.insert(context); }
  [[nodiscard]] bool tolerates(std::string_view name) const {
    const auto starts_name = [&](const std::string& context) { return name.starts_with(context); };
    return std::ranges::any_of(bad_contexts_, starts_name);
  }

  // Nothing is wrong so far but what --strict makes an error.
  [[nodiscard]] bool no_errors() const { return out_.error_count() == strict_warnings_; }
  void line(const xml::Position& position, std::string finished_line);

  // The nearest name, for the first 200 questions only: comparing each of 10,000 wrong names with 10,000
  // right ones would take minutes, and nobody reads that many hints.
  std::optional<std::string> nearest(std::string_view word, std::span<const std::string> candidates);
  // The same as the end of a message.
  std::string hint(std::string_view word, std::span<const std::string> candidates);
  // The same for a name that may only lack its context: "avoid" for "left/avoid".
  std::string hint_in_contexts(std::string_view name, std::span<const std::string> candidates);

 private:
  bool told_already(const char* code, const xml::Position& position, const std::string& message);

  xml::Diagnostics& out_;
  const bool strict_;
  std::size_t strict_warnings_ = 0;
  std::set<std::string> shared_files_;
  std::set<std::string> bad_contexts_;
  std::set<std::string> told_;  // in the shared files, and finished lines
  int hints_left_ = 200;
};

}  // namespace orca::graph
