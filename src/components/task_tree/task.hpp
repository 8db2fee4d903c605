// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "condition.hpp"
#include "orca/goals/trip.hpp"
#include "orca/xml/diagnostics.hpp"

namespace orca::tasks {

/// The kinds of step, named as in a task file (README.md). The words are those of BehaviorTree.CPP where they fit.
enum class Kind {
  sequence,
  fallback,
  parallel,
  repeat,
  retry,
  timeout,
  with,
  suspend,
  attempt,
  on,
  caught,
  drive,
  wait,
  say,
  ask,
  check
};

/// The way on after a handler.
enum class Then {
  resume,  ///< At the step that was given up or has failed.
  again,   ///< From the beginning.
  done,    ///< As if all were done.
  fail     ///< With a failure.
};

/// A step of a task. The steps of a task stand in one list, in the order of the file; 0 is the root.
struct Step {
  Kind kind = Kind::sequence;
  std::string text{};                   ///< For people: "Drive kitchen".
  std::size_t depth = 0;                ///< Below the root.
  std::vector<std::size_t> children{};  ///< An attempt has what is tried, then its handlers.
  xml::Position position{};

  go::Trip trip{};          ///< Drive.
  std::string words{};      ///< Say, ask; of a caught failure the kind, empty: any; with: the value.
  std::string component{};  ///< With: that of the parameter; suspend.
  std::string param{};      ///< With.
  std::optional<Condition> condition{};  ///< Check, on.
  Then then = Then::fail;                ///< On, caught.
  std::uint32_t count =
      0;  ///< Repeat, retry, caught: how often at most, 0: without end; parallel: how many must be done.
  double time = 0.0;  ///< [s] Wait, timeout, repeat; drive, ask, check: the longest; 0: not limited.
};

struct Task {
  std::string name;
  std::vector<Step> steps;
};

/// Reads a task file.
/// @param sights       that conditions may look at.
/// @param diagnostics  receives every error of the file with its position: G1xx for XML that is not well-formed, K0xx
///                     for its content (README.md).
/// @return nothing if there is no task in the file. With errors, the task is what could be read, so that all of it can be checked.
[[nodiscard]] std::optional<Task> read_task(const std::string& path, std::span<const Sight> sights,
                                            xml::Diagnostics& diagnostics);
/// Does the same for text in memory; `file_name` only appears in positions.
[[nodiscard]] std::optional<Task> read_task_text(std::string_view text, const std::string& file_name,
                                                 std::span<const Sight> sights,
                                                 xml::Diagnostics& diagnostics);

}  // namespace orca::tasks
