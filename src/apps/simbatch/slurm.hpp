// SPDX-License-Identifier: GPL-3.0-or-later
// Additional permission: LICENSES/Orca-plugin-exception.txt
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

#include "orca/base/result.hpp"

namespace orca::simbatch {

/// The jobs of a batch in the queue of a Slurm cluster: an array with a task for each shard, and one that joins their results when
/// all have ended.
struct SlurmJobs {
  std::string shards;  ///< Numbers by which Slurm knows them.
  std::string join;
};

/// How many tasks of the array are in which state; a task that is not in the queue any more has ended.
struct SlurmQueue {
  std::size_t waiting = 0;
  std::size_t running = 0;
  bool joins = false;  ///< The join is not done.
  [[nodiscard]] bool empty() const { return waiting == 0 && running == 0 && !joins; }
};

/// What is handed to the queue.
struct SlurmBatch {
  std::filesystem::path program;     ///< simbatch itself.
  std::filesystem::path experiment;  ///< Absolute, like the folder; both at the same place on all nodes.
  std::filesystem::path folder;      ///< For results, scripts and logs.
  std::string name;
  std::size_t shards = 1;
  std::vector<std::string> plugins{};  ///< Further folders with plugins, absolute.
};

/// Writes the two scripts into the folder and hands them to sbatch.
/// @errors  those of writing and of sbatch.
Result<SlurmJobs> submit(const SlurmBatch& batch);

/// @errors  squeue cannot be asked at present.
Result<SlurmQueue> look(const SlurmJobs& jobs);

}  // namespace orca::simbatch
