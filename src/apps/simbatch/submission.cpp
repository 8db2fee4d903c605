// SPDX-License-Identifier: GPL-3.0-or-later
// Additional permission: LICENSES/Orca-plugin-exception.txt
#include "submission.hpp"

#include <unistd.h>

#include <chrono>
#include <cstdio>
#include <filesystem>
#include <thread>

#include "folders.hpp"
#include "orca/base/live_line.hpp"
#include "orca/base/text.hpp"
#include "slurm.hpp"

namespace orca::simbatch {
namespace {

constexpr auto kBetweenLooks = std::chrono::seconds(2);

std::string state_text(const SlurmQueue& queue, std::size_t shards) {
  const std::size_t open = queue.waiting + queue.running;
  return std::to_string(shards - std::min(open, shards)) + " of " + std::to_string(shards) +
         " parts have ended, " + std::to_string(queue.running) + " run, " + std::to_string(queue.waiting) +
         " wait";
}

// A terminal gets one line that changes; elsewhere there is a line for each change.
void show(const std::string& state, std::string& last) {
  if (state == last) return;
  last = state;
  if (isatty(STDERR_FILENO) != 0) return LiveLine::show(STDERR_FILENO, state);
  std::fprintf(stderr, "%s\n", state.c_str());
}

// Returns when no job is in the queue any more. A controller that does not answer is asked again.
void watch(const SlurmJobs& jobs, std::size_t shards) {
  std::string last;
  for (;; std::this_thread::sleep_for(kBetweenLooks)) {
    const Result<SlurmQueue> queue = look(jobs);
    if (queue && queue->empty()) break;
    show(queue ? state_text(*queue, shards) : "Slurm does not answer; it is asked again", last);
  }
  LiveLine::erase();
}

Status check_folder(const std::filesystem::path& folder, bool resume) {
  const bool has_parts = std::filesystem::exists(folder / "shard_1");
  if (!has_parts && std::filesystem::exists(results_in(folder)))
    return fail(Code::already_exists,
                in_quotes(folder.string()) +
                    " holds results that were not made by submit; --out DIR takes another folder");
  if (has_parts && !resume)
    return fail(Code::already_exists,
                in_quotes(folder.string()) +
                    " holds parts already; --resume makes what is missing in them, --out DIR "
                    "takes another folder");
  return ok();
}

}  // namespace

ExitCode submit(const Options& options, const batch::Experiment& experiment) {
  const std::filesystem::path folder =
      std::filesystem::absolute(options.out.empty() ? experiment.name + ".batch" : options.out)
          .lexically_normal();
  if (const Status free = check_folder(folder, options.resume); !free.ok()) return refuse(free.error());
  const Result<SlurmJobs> jobs =
      simbatch::submit({.program = std::filesystem::read_symlink("/proc/self/exe"),
                        .experiment = std::filesystem::absolute(options.subject).lexically_normal(),
                        .folder = folder,
                        .name = experiment.name,
                        .shards = options.shards,
                        .plugins = options.plugins});
  if (!jobs) {
    std::fprintf(stderr, "error: %s\n", jobs.error().text().c_str());
    return ExitCode::could_not_finish;
  }
  std::fprintf(stderr, "Slurm has %zu parts as job %s and their join as %s; Ctrl-C leaves them there\n",
               options.shards, jobs->shards.c_str(), jobs->join.c_str());
  watch(*jobs, options.shards);
  if (!std::filesystem::exists(results_in(folder))) {
    std::fprintf(stderr, "error: the parts were not joined; %s says why\n", (folder / "logs").c_str());
    return ExitCode::could_not_finish;
  }
  std::fprintf(stderr, "results: %s\n", results_in(folder).c_str());
  return ExitCode::done;
}

}  // namespace orca::simbatch
