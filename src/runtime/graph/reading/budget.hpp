// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <cstddef>

#include "orca/xml/diagnostics.hpp"
#include "orca/xml/document.hpp"
#include "report.hpp"

namespace orca::graph {

// A limit to the growth of a graph by included files and arguments. A few small files that name each other
// ten times over must not cost gigabytes.
class Budget {
 public:
  // Returns false, after one report, when the budget is used up.
  bool take_file(const xml::Position& position, Report& report);
  bool take_elements(std::size_t count, const xml::Position& position, Report& report);
  bool take_characters(std::size_t count, const xml::Position& position, Report& report);

 private:
  // Copies of files are dear: each has its own arguments and names. A component may be a file of its own.
  static constexpr std::size_t kFiles = 10'000;
  static constexpr std::size_t kElements = 100'000;

  std::size_t files_ = kFiles;
  std::size_t elements_ = kElements;
  std::size_t characters_ = xml::Limits::kBytes;
  bool files_told_ = false;
  bool elements_told_ = false;
  bool characters_told_ = false;
};

}  // namespace orca::graph
