// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace orca::test {

/// A line of `--trace`: "12.500000 connect avoid.sonar base.SonarRangeReadingsPush".
struct TraceLine {
  double time = 0.0;               ///< [s]
  std::string event;               ///< connect, disconnect, deliver or state.
  std::vector<std::string> words;  ///< The words after the event.

  [[nodiscard]] bool is(std::string_view wanted, const std::vector<std::string>& first_words) const;
};

/// A trace as it was written to a file.
class TraceFile {
 public:
  static constexpr std::size_t kNever = static_cast<std::size_t>(-1);

  explicit TraceFile(const std::string& path);

  [[nodiscard]] const std::vector<TraceLine>& lines() const { return lines_; }

  /// Returns the index of the first line, from `from` on, that has this event and begins with these words;
  /// kNever if there is none.
  [[nodiscard]] std::size_t find(std::string_view event, const std::vector<std::string>& words,
                                 std::size_t from = 0) const;
  [[nodiscard]] bool has(std::string_view event, const std::vector<std::string>& words,
                         std::size_t from = 0) const {
    return find(event, words, from) != kNever;
  }

  /// Returns the last state of a component or a hardware container before `end`; empty if there is none.
  [[nodiscard]] std::string state_before(std::string_view name, std::size_t end = kNever) const;

  /// Returns the connections that are open before `end`, each as "avoid.sonar base.SonarRangeReadingsPush",
  /// sorted.
  [[nodiscard]] std::vector<std::string> open_connections(std::size_t end = kNever) const;

 private:
  std::vector<TraceLine> lines_;
};

}  // namespace orca::test
