// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <algorithm>
#include <set>
#include <span>
#include <string>
#include <string_view>

#include "orca/xml/reporter.hpp"

namespace orca::graph {

// The collector of what the checks of a graph find.
class Report final : public xml::Reporter {
 public:
  // @param strict  warnings are errors
  explicit Report(xml::Diagnostics& out, bool strict = false) : Reporter(out), strict_(strict) {}

  // Marks a file as part of the graph several times. An error in it is reported once, not for each copy.
  void share(const std::string& file) { shared_files_.insert(file); }

  void error(const char* code, const xml::Position& position, std::string message) override;
  void warning(const char* code, const xml::Position& position, std::string message);
  // Reports no more names that begin with `context`, which is reported as an invalid name already.
  void tolerate(const std::string& context) { bad_contexts_.insert(context); }
  [[nodiscard]] bool tolerates(std::string_view name) const {
    const auto starts_name = [&](const std::string& context) { return name.starts_with(context); };
    return std::ranges::any_of(bad_contexts_, starts_name);
  }

  // Returns whether no error was found, apart from warnings that --strict makes errors.
  [[nodiscard]] bool no_errors() const { return diagnostics().error_count() == strict_warnings_; }
  void line(const xml::Position& position, std::string finished_line);

  // Returns a hint at a name that may only lack its context: "avoid" for "left/avoid".
  std::string hint_in_contexts(std::string_view name, std::span<const std::string> candidates);

 private:
  bool told_already(const char* code, const xml::Position& position, const std::string& message);

  const bool strict_;
  std::size_t strict_warnings_ = 0;
  std::set<std::string> shared_files_;
  std::set<std::string> bad_contexts_;
  std::set<std::string> told_;  // in the shared files, and finished lines
};

}  // namespace orca::graph
