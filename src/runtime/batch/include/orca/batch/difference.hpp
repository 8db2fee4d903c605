// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <string_view>

#include "orca/base/result.hpp"
#include "orca/batch/experiment.hpp"
#include "orca/batch/one_run.hpp"

namespace orca::batch {

/// An object that was put into the queue of a port, as a line of a run's trace says it. A plain value.
struct Delivery {
  std::string time;  ///< [s] since the start of the run.
  std::string component;
  std::string port;
  std::string seq;  ///< The object's.
  std::string type;
  std::string origin;  ///< Component that made the object.
  std::string value;   ///< The object as text (docs/objects.md).
  friend bool operator==(const Delivery&, const Delivery&) = default;

  /// Returns all but the value for people: "GoalPoint 12 of command to goto.goals at 3.200000 s".
  [[nodiscard]] std::string text() const;
};

/// Reads a line of a trace; nothing if it is no delivery.
[[nodiscard]] std::optional<Delivery> read_delivery(std::string_view line);

/// The first place in which two runs part.
struct DeliveryDifference {
  std::size_t number = 0;          ///< The delivery's in its run, from 1.
  std::optional<Delivery> first;   ///< Nothing: the first run has no more deliveries.
  std::optional<Delivery> second;  ///< Likewise.

  /// Returns what differs in one line, the values included.
  /// @param one, other  what the runs are called: "A", "the first time".
  [[nodiscard]] std::string text(const std::string& one, const std::string& other) const;
};

/// A run that is to be made once more.
struct RunAgain {
  const Experiment& experiment;
  std::size_t number;  ///< The run's in it.
  const BatchOptions& options;
};

/// The outcome of two runs that were made side by side.
struct PairOfRuns {
  std::optional<DeliveryDifference>
      difference;            ///< Nothing: all deliveries are the same, to the microsecond.
  std::string first_hash{};  ///< Trace hashes; empty if the runs differ, or have none.
  std::string second_hash{};
};

/// Makes two runs side by side, the second in other circumstances, until their deliveries differ or both have ended. It keeps
/// no trace.
/// @param give_up  is asked a few times a second.
/// @errors  unavailable if no process can be started; failed_precondition if `give_up` said so; deadline_exceeded if a run hangs.
/// @thread  the main thread, while there is no other.
[[nodiscard]] Result<PairOfRuns> make_both(const RunAgain& first, const RunAgain& second,
                                           const std::function<bool()>& give_up);

}  // namespace orca::batch
