// SPDX-License-Identifier: GPL-3.0-or-later
// Additional permission: LICENSES/Orca-plugin-exception.txt
#pragma once

#include <chrono>
#include <cstddef>
#include <string>
#include <vector>

#include "orca/batch/batch.hpp"
#include "orca/batch/store.hpp"

namespace orca::simbatch {

/// Stores the outcomes of a batch and shows how it is going: on a terminal a line that changes, otherwise one every few
/// seconds, on stderr.
///
/// Thread contract: as BatchListener.
class Progress final : public batch::BatchListener {
 public:
  /// @param wanted  number of runs that are to be made.
  Progress(const batch::Experiment& experiment, batch::Store& store, std::size_t wanted);

  Status finished(std::size_t number, const batch::Outcome& outcome, const batch::Cost& cost) override;
  Status repeated(std::size_t number, const batch::Repeat& repeat) override;
  void overloaded(std::size_t number, const std::string& why, bool again) override;
  void tick(std::size_t running) override;
  /// Takes the line away.
  void end();

 private:
  using Clock = std::chrono::steady_clock;

  [[nodiscard]] std::string text(std::size_t running) const;
  [[nodiscard]] std::string name_of(std::size_t number) const;

  struct Count {
    std::size_t done = 0;
    std::size_t successes = 0;
  };

  const batch::Experiment& experiment_;
  batch::Store& store_;
  const std::size_t wanted_;
  const bool live_;
  const Clock::time_point start_ = Clock::now();
  Clock::time_point next_line_ = start_;
  std::vector<Count> of_variant_;
  std::size_t done_ = 0;
  std::size_t failed_ = 0;  // crashes, hangs and failures: what is no result of the algorithm alone
};

}  // namespace orca::simbatch
