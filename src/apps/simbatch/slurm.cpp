// SPDX-License-Identifier: GPL-3.0-or-later
// Additional permission: LICENSES/Orca-plugin-exception.txt
#include "slurm.hpp"

#include <sstream>

#include "command.hpp"
#include "orca/base/output_file.hpp"
#include "orca/base/text.hpp"

namespace orca::simbatch {
namespace {

Status write_script(const std::filesystem::path& file, const std::string& command) {
  OutputFile out("a script for Slurm");
  if (const Status opened = out.open(file.string()); !opened.ok()) return opened;
  out.write("#!/bin/sh\n" + command + "\n");
  return out.close();
}

// A task that a lost node cut off is queued again by Slurm, and goes on where it was.
std::string shard_command(const SlurmBatch& batch) {
  std::string plugins;
  for (const std::string& folder : batch.plugins) plugins += " --plugins " + in_shell_quotes(folder);
  return "exec " + in_shell_quotes(batch.program.string()) + " " +
         in_shell_quotes(batch.experiment.string()) + " --out " +
         in_shell_quotes((batch.folder / "shard_").string()) +
         "\"$SLURM_ARRAY_TASK_ID\" --shard \"$SLURM_ARRAY_TASK_ID\"/" + std::to_string(batch.shards) +
         " --jobs \"${SLURM_CPUS_ON_NODE:-1}\" --resume" + plugins;
}

// What was joined before is made anew: the parts hold all of it.
std::string join_command(const SlurmBatch& batch) {
  return "rm -f " + in_shell_quotes((batch.folder / "results.sqlite").string()) + "*\n" + "exec " +
         in_shell_quotes(batch.program.string()) + " join " +
         in_shell_quotes((batch.folder / "shard_").string()) + "* --out " +
         in_shell_quotes(batch.folder.string());
}

// Returns the number by which Slurm knows the job; sbatch may add ";CLUSTER".
Result<std::string> queued(std::vector<std::string> words) {
  words.insert(words.begin(), {"sbatch", "--parsable", "--requeue"});
  const Result<std::string> out = output_of(words);
  if (!out) return out.error();
  const std::string number = out->substr(0, out->find_first_of(";\n"));
  if (number.empty()) return fail(Code::unavailable, "sbatch gave no number of a job");
  return number;
}

std::string log_option(const SlurmBatch& batch, const std::string& name) {
  return "--output=" + (batch.folder / "logs" / name).string();
}

}  // namespace

Result<SlurmJobs> submit(const SlurmBatch& batch) {
  const auto shard = batch.folder / "shard.sh";
  const auto join = batch.folder / "join.sh";
  std::error_code error;
  std::filesystem::create_directories(batch.folder / "logs", error);
  if (error) return fail(Code::unavailable, batch.folder.string() + ": " + error.message());
  if (Status written = write_script(shard, shard_command(batch)); !written.ok()) return written.error();
  if (Status written = write_script(join, join_command(batch)); !written.ok()) return written.error();
  const Result<std::string> shards =
      queued({"--job-name=" + batch.name, "--array=1-" + std::to_string(batch.shards),
              log_option(batch, "shard_%a.log"), "--open-mode=append", shard.string()});
  if (!shards) return shards.error();
  const Result<std::string> joined =
      queued({"--job-name=" + batch.name + "_join", "--dependency=afterany:" + *shards,
              log_option(batch, "join.log"), join.string()});
  if (!joined) return joined.error();
  return SlurmJobs{*shards, *joined};
}

Result<SlurmQueue> look(const SlurmJobs& jobs) {
  const Result<std::string> out = output_of({"squeue", "--noheader", "--array", "--format=%F %t"});
  if (!out) return out.error();
  SlurmQueue queue;
  std::istringstream lines(*out);
  for (std::string job, state; lines >> job >> state;) {
    if (job == jobs.join) queue.joins = true;
    if (job != jobs.shards) continue;
    ++(state == "PD" ? queue.waiting : queue.running);
  }
  return queue;
}

}  // namespace orca::simbatch
