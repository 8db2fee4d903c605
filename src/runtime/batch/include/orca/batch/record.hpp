// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "orca/batch/measures.hpp"

namespace orca::batch {

/// The end of a run. The names are those of the table of results, and never change.
enum class Ending : std::uint8_t {
  success,      ///< All goals were reached, and nothing was touched.
  contact,      ///< A robot touched something.
  goal_failed,  ///< A goal was given up, or claimed where the robot was not.
  time_out,     ///< The experiment's time was up before.
  failed,       ///< A component failed, or something did not start.
  crash,        ///< The process of the run died.
  hang          ///< It did not end within the experiment's wall clock limit, and was killed.
};

[[nodiscard]] const char* name_of(Ending ending);
/// Returns the ending of that name; nothing if there is none.
[[nodiscard]] std::optional<Ending> ending_of(std::string_view name);

/// The outcome of a run, the same whenever and wherever it is made. A plain value.
struct Outcome {
  Ending ending = Ending::crash;
  std::string reason;  ///< The reason of a failure, a crash or a hang; otherwise empty.
  double time =
      0.0;  ///< [s] simulated, from the start to the last arrival of a success, otherwise to the end.
  std::uint32_t goals = 0;  ///< Number that were reached.
  std::uint32_t failed_goals =
      0;  ///< Number that were given up, or claimed wrongly, before they were reached.
  std::uint32_t contacts = 0;
  Failure failure = Failure::none;
  Measures measures{};
  std::string trace_hash{};  ///< 16 hexadecimal digits; empty: the run did not come so far.
  Sketch sketch{};
  friend bool operator==(const Outcome&, const Outcome&) = default;
};

/// The processor time that the laps of one component took.
struct LapCost {
  std::string component;
  std::uint64_t laps = 0;
  double mean = 0.0;     ///< [s]
  double p95 = 0.0;      ///< [s] What 95 % of them took at most, to 6 %.
  double longest = 0.0;  ///< [s] Likewise.
  friend bool operator==(const LapCost&, const LapCost&) = default;
};

/// The cost of a run to the machine. It differs each time.
struct Cost {
  double wall = 0.0;            ///< [s]
  double cpu = 0.0;             ///< [s] of all its threads.
  std::vector<LapCost> laps{};  ///< None if it did not come to its end.
};

/// The result of making a run twice, the second time with another memory layout, process, environment and folder. A plain value.
struct Repeat {
  std::string first;   ///< Trace hash, or the name of the ending if there is none.
  std::string second;  ///< Likewise, of the second time.
  std::string
      difference{};  ///< Empty: all is the same. Otherwise what differs, for people: the first differing delivery.
  friend bool operator==(const Repeat&, const Repeat&) = default;
};

/// Writes an outcome as text, one line for each part.
[[nodiscard]] std::string to_text(const Outcome& outcome);
/// Reads such a text; nothing if it is not whole.
[[nodiscard]] std::optional<Outcome> read_outcome(std::string_view text);

/// Write what laps cost as one line, and read it; nothing if it is no such line.
[[nodiscard]] std::string laps_text(const std::vector<LapCost>& laps);
[[nodiscard]] std::optional<std::vector<LapCost>> read_laps(std::string_view text);

}  // namespace orca::batch
