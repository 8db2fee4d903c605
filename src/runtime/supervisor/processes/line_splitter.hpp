// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace orca::supervisor {

/// Cuts what a process prints into lines, in memory that is limited whatever it prints.
///
/// Thread contract: not synchronised.
class LineSplitter {
 public:
  static constexpr std::size_t kLongest = 2000;  ///< [bytes] The rest of a line is left out.

  /// Adds what has been printed next.
  /// @return the lines that it completes, printable and without their ends.
  [[nodiscard]] std::vector<std::string> add(std::string_view printed);
  /// Returns the line that has no end yet, at the end of everything; none if there is nothing.
  [[nodiscard]] std::vector<std::string> finish();

 private:
  void append(std::string_view part);
  std::string take();

  std::string line_;     // without an end yet
  bool is_cut_ = false;  // whether something of it is left out
};

}  // namespace orca::supervisor
