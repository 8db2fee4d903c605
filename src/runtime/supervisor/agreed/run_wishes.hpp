// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "orca/base/executive.hpp"
#include "orca/base/log.hpp"
#include "orca/base/result.hpp"
#include "orca/base/time.hpp"
#include "orca/host/planned_failure.hpp"
#include "orca/host/run_outputs.hpp"
#include "orca/supervisor/vocabulary.hpp"

namespace orca::supervisor {

/// What the command line asks of a run, as far as a host process must know it. A plain value.
struct RunWishes {
  std::uint64_t seed = 1;
  log::Level log_level = log::Level::info;
  Duration epoch{0};  ///< What the clock of all processes adds to the system's steady clock [s].
  TimePoint start{};  ///< Of the run, for the log.
  std::optional<Backend> executor{};  ///< None: as the graph says.
  std::vector<host::PlannedFailure> failures{};
  host::RunOutputs outputs{};  ///< Of this process.
  std::string run{};           ///< Its name, which no other run has.
};

/// Returns the wishes as the options of a Setup.
[[nodiscard]] Pairs to_pairs(const RunWishes& wishes);

/// Reads the options of a Setup.
/// @errors  data_loss for an option that to_pairs() does not write.
[[nodiscard]] Result<RunWishes> read_wishes(const Pairs& pairs);

}  // namespace orca::supervisor
