// SPDX-License-Identifier: GPL-3.0-or-later
// Additional permission: LICENSES/Orca-plugin-exception.txt
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "commands.hpp"
#include "orca/base/result.hpp"
#include "orca/base/time.hpp"

namespace orca::orcactl {

/// One call of orcactl, as the command line says it. A plain value.
struct Call {
  const Command* command = nullptr;  ///< Null: only help is wanted.
  std::vector<std::string> words;    ///< The arguments.
  /// Options of the command by their names, "" for those without a value.
  std::multimap<std::string, std::string, std::less<>> options;
  std::string system;  ///< Empty: the one that runs.
  bool json = false;
  bool watch = false;
  bool help = false;

  [[nodiscard]] bool has(std::string_view option) const { return options.contains(option); }
  /// Returns the value of an option that holds a span of time, or a count, as parse_call() has checked it.
  [[nodiscard]] std::optional<Duration> duration(std::string_view option) const;
  [[nodiscard]] std::optional<std::uint64_t> count(std::string_view option) const;
  /// Returns the value of an option as it is written.
  [[nodiscard]] std::optional<std::string> text(std::string_view option) const;
};

/// Reads a command line.
/// @param words  without the program's name.
/// @errors  invalid_argument, with what is wrong and the nearest right word.
[[nodiscard]] Result<Call> parse_call(const std::vector<std::string>& words);

}  // namespace orca::orcactl
