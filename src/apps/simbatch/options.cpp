// SPDX-License-Identifier: GPL-3.0-or-later
// Additional permission: LICENSES/Orca-plugin-exception.txt
#include "options.hpp"

#include <algorithm>
#include <map>
#include <thread>

#include "common/manual.hpp"
#include "orca/base/files/own_library.hpp"
#include "orca/base/text.hpp"
#include "orca/xml/number.hpp"

namespace orca::simbatch {
namespace {

constexpr std::int64_t kMostShards = 100'000;

constexpr std::string_view kDetails =
    R"(  simbatch sim/experiments/avoid_office.xml              all runs, into the folder avoid_office.batch
  simbatch sim/experiments/avoid_office.xml --check      only say what is wrong with the experiment and its graphs
  simbatch sim/experiments/avoid_office.xml --resume     what is missing in the folder, never anything twice
  simbatch report sim/experiments/avoid_office.xml       the report once more, on the results that there are
  simbatch export avoid_office.batch                     one line for each run as CSV, in a fixed order
  simbatch sim/experiments/avoid_office.xml --shard 2/7  the second of seven parts, into avoid_office.2-of-7.batch
  simbatch join avoid_office.*-of-7.batch --out all      the parts together, as if one machine had made all
  simbatch submit sim/experiments/barn.xml --slurm       the parts as jobs of a Slurm cluster, and their join
  simbatch diff before.batch after.batch                 the first run that differs, and the first delivery in it that does
  simbatch pack sim/experiments/avoid_office.xml         avoid_office.batch/avoid_office.pack.tar.gz, for others to repeat
  simbatch repeat avoid_office.pack.tar.gz               its runs once more, and whether they are the same to the last byte
  simbatch tune sim/experiments/barn.xml                 the best settings of each variant, into the folder barn.tuned

Each run is made in a process of its own, so one that crashes, hangs or takes too much memory costs no other; it is a result,
too. Ctrl-C and kill -9 lose nothing that was finished. The same experiment gives the same bytes, whatever --jobs and the
machine's load are.

Some runs of each variant, one in a hundred or more, are made twice, the second time with other addresses, environment, process
and folder. If the two differ, a warning names the first delivery that does, and the batch goes on. A run that an overloaded machine does not let end
is no result: it is made again. --resume and join refuse results of other plugins, files or programs.
)";

constexpr std::string_view kDiffDetails =
    "It makes the first run that differs again, as both batches did, and watches all that its components "
    "receive: it names the time, the component, the port and the values that differ. Exit status 0: the "
    "same, 1: different.";

constexpr std::string_view kSubmitDetails =
    "It queues an array with a part of the experiment in each task, and a job that joins them when all have "
    "ended, and shows how far they are. A task that is cut off goes on where it was. Ctrl-C ends the looking "
    "on; with --resume it queues what is missing. sbatch reads its own settings, such as SBATCH_PARTITION; "
    "programs, experiment and folder must be at the same place on all nodes.";

constexpr std::string_view kRepeatDetails =
    "It unpacks NAME.pack.tar.gz into the folder NAME.repeat, or --out, checks that all files are as they "
    "were, names the programs and plugins that are built otherwise here, makes all runs and compares "
    "runs.csv byte for byte. With --resume it goes on. Exit status 0: the same, 1: different or not "
    "finished, 2: the archive is damaged, and nothing was run.";

constexpr std::string_view kTuneDetails =
    "It makes the draws that <tuning> asks for of each variant with a <tune>, all with the same budget, in "
    "the worlds of <tuning>, none of which the experiment may compare in. Into the folder NAME.tuned, or "
    "--out, it writes draws.csv and, for each variant, a file with the best settings and the budget, which "
    "a variant takes by its attribute settings. With --resume it goes on.";

const apps::Argument kExperiment{"EXPERIMENT.xml", apps::Names::file};

const apps::Program& program() {
  static const apps::Program all{
      .name = "simbatch",
      .usage = "EXPERIMENT.xml [options]",
      .text = "run variants x worlds x seeds in simulated time, and compare them",
      .details = kDetails,
      .arguments = {kExperiment},
      .commands = {{.name = "report",
                    .arguments = {kExperiment},
                    .text = "make the report again, on the results that there are"},
                   {.name = "export",
                    .arguments = {{"DIR"}},
                    .text = "print one line for each run as CSV, in a fixed order"},
                   {.name = "status",
                    .arguments = {{"DIR"}},
                    .text = "print how far a batch is, and which runs have failed, as JSON"},
                   {.name = "join",
                    .arguments = {{"DIR"}, {"DIR", apps::Names::none, true, true}},
                    .text = "put the results of all parts together in the folder --out"},
                   {.name = "submit",
                    .arguments = {kExperiment},
                    .options = {{"--slurm", "",
                                 "the kind of cluster, which is needed: there is no other yet"},
                                {"--shards", "N", "number of parts (default 16)", false, {}, 1, 1000}},
                    .text = "give the parts to a cluster, and join them",
                    .details = kSubmitDetails},
                   {.name = "diff",
                    .arguments = {{"BEFORE"}, {"AFTER"}},
                    .text = "say which run differs first in two results, and in what",
                    .details = kDiffDetails},
                   {.name = "pack",
                    .arguments = {kExperiment},
                    .text = "put the experiment, all files that it reads and its results into one archive"},
                   {.name = "repeat",
                    .arguments = {{"PACK", apps::Names::file}},
                    .text = "unpack an archive, make all its runs again, and compare the results",
                    .details = kRepeatDetails},
                   {.name = "tune",
                    .arguments = {kExperiment},
                    .text = "choose settings by random search, in worlds of the tuner's own",
                    .details = kTuneDetails}},
      .options = {{"--check", "", "only say what is wrong with the experiment and its graphs", false,
                   "Options"},
                  {"--out", "DIR",
                   "folder for results.sqlite, report.html and report.md (default: the experiment's name "
                   "with .batch)"},
                  {"--jobs", "N", "runs at a time (default: as many as processors)", false, {}, 1, 1024},
                  {"--resume", "", "go on with the results that the folder holds"},
                  {"--shard", "I/N",
                   "only part I of N, for instance on N machines; every part has all variants of its worlds "
                   "and seeds"},
                  {"--executor", "fiber|baton", "what the components run on (default fiber)"},
                  {"--plugins", "FOLDER", "look for plugins here too, after Orca's own", true}},
      .exits = {"0 done (runs that failed are results)", "1 could not finish",
                "2 bad input, nothing was run"},
      .notes = "docs/comparing.md explains experiments.\n"};
  return all;
}

Result<batch::Shard> read_shard(const std::string& value) {
  const std::size_t slash = std::min(value.find('/'), value.size());
  const Result<std::int64_t> number = xml::parse_integer(value.substr(0, slash));
  const Result<std::int64_t> count = xml::parse_integer(value.substr(std::min(slash + 1, value.size())));
  if (number && count && *number >= 1 && *count >= *number && *count <= kMostShards)
    return batch::Shard{static_cast<std::size_t>(*number), static_cast<std::size_t>(*count)};
  return fail(Code::invalid_argument,
              "--shard takes I/N, part I of N parts from 1/N to N/N, e.g. 2/7; found " + in_quotes(value));
}

Options::Action action_of(const apps::Call& call) {
  using Action = Options::Action;
  static const std::map<std::string_view, Action> all{
      {"export", Action::table}, {"report", Action::report}, {"diff", Action::diff},
      {"join", Action::join},    {"status", Action::status}, {"submit", Action::submit},
      {"pack", Action::pack},    {"repeat", Action::repeat}, {"tune", Action::tune}};
  if (call.command != nullptr) return all.at(call.command->name);
  return call.has("--check") ? Action::check : Action::run;
}

Status check(const Options& options) {
  if (options.action == Options::Action::join && options.out.empty())
    return fail(Code::invalid_argument,
                "join needs one folder for all, e.g. join 1-of-2.batch 2-of-2.batch --out all.batch");
  if (options.action == Options::Action::submit && !options.slurm)
    return fail(Code::invalid_argument, "submit needs --slurm: there is no other kind of cluster yet");
  return ok();
}

}  // namespace

Result<Options> parse_options(const std::vector<std::string>& words) {
  const apps::Call call = apps::parse(program(), words);
  if (!call.problems.empty()) return fail(Code::invalid_argument, call.problems.front().message);
  Options options;
  options.answer = apps::answer(program(), call);
  if (options.answer) return options;
  options.action = action_of(call);
  options.subject = or_own_file(call.words.front());
  options.others.assign(call.words.begin() + 1, call.words.end());
  options.plugins = call.folders("--plugins");
  options.out = call.text("--out").value_or("");
  options.resume = call.has("--resume");
  options.slurm = call.has("--slurm");
  options.shards = call.count("--shards").value_or(options.shards);
  options.batch.jobs = call.count("--jobs").value_or(std::max(1U, std::thread::hardware_concurrency()));
  options.batch.backend = call.text("--executor") == "baton" ? Backend::baton : Backend::fiber;
  if (const auto value = call.text("--shard")) {
    const Result<batch::Shard> shard = read_shard(*value);
    if (!shard) return shard.error();
    options.shard = *shard;
  }
  if (Status checked = check(options); !checked.ok()) return checked.error();
  return options;
}

}  // namespace orca::simbatch
