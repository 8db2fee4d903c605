// SPDX-License-Identifier: GPL-3.0-or-later
// Additional permission: LICENSES/Orca-plugin-exception.txt
#include "options.hpp"

#include <filesystem>
#include <functional>
#include <map>
#include <thread>

#include "orca/base/text.hpp"
#include "orca/xml/number.hpp"

namespace orca::simbatch {
namespace {

constexpr std::int64_t kMostShards = 100'000;

Status set_jobs(Options& options, const std::string& value) {
  const Result<std::int64_t> jobs = xml::parse_integer(value);
  if (!jobs || *jobs < 1 || *jobs > 1024)
    return fail(Code::invalid_argument, "--jobs takes a number from 1 to 1024, found " + in_quotes(value));
  options.batch.jobs = static_cast<std::size_t>(*jobs);
  return ok();
}

Status set_executor(Options& options, const std::string& value) {
  if (value != "fiber" && value != "baton")
    return fail(Code::invalid_argument, "--executor takes fiber or baton, found " + in_quotes(value));
  options.batch.backend = value == "fiber" ? Backend::fiber : Backend::baton;
  return ok();
}

Status set_shard(Options& options, const std::string& value) {
  const std::size_t slash = std::min(value.find('/'), value.size());
  const Result<std::int64_t> number = xml::parse_integer(value.substr(0, slash));
  const Result<std::int64_t> count = xml::parse_integer(value.substr(std::min(slash + 1, value.size())));
  if (!number || !count || *number < 1 || *count < *number || *count > kMostShards)
    return fail(Code::invalid_argument,
                "--shard takes I/N, part I of N parts from 1/N to N/N, e.g. 2/7; found " + in_quotes(value));
  options.shard = {static_cast<std::size_t>(*number), static_cast<std::size_t>(*count)};
  return ok();
}

Status set_shards(Options& options, const std::string& value) {
  const Result<std::int64_t> shards = xml::parse_integer(value);
  if (!shards || *shards < 1 || *shards > 1000)
    return fail(Code::invalid_argument, "--shards takes a number from 1 to 1000, found " + in_quotes(value));
  options.shards = static_cast<std::size_t>(*shards);
  return ok();
}

Status set_out(Options& options, const std::string& value) {
  if (value.empty()) return fail(Code::invalid_argument, "--out takes the name of a folder, found none");
  options.out = value;
  return ok();
}

Status add_plugins(Options& options, const std::string& value) {
  if (value.empty()) return fail(Code::invalid_argument, "--plugins takes the name of a folder, found none");
  options.plugins.push_back(std::filesystem::absolute(value).string());
  return ok();
}

using WithValue = std::function<Status(Options&, const std::string&)>;

const std::map<std::string, WithValue>& options_with_value() {
  static const std::map<std::string, WithValue> all{{"--jobs", set_jobs},   {"--executor", set_executor},
                                                    {"--shard", set_shard}, {"--shards", set_shards},
                                                    {"--out", set_out},     {"--plugins", add_plugins}};
  return all;
}

const std::map<std::string, std::function<void(Options&)>>& flags() {
  using Action = Options::Action;
  static const std::map<std::string, std::function<void(Options&)>> all{
      {"--resume", [](Options& options) { options.resume = true; }},
      {"--slurm", [](Options& options) { options.slurm = true; }},
      {"--check", [](Options& options) { options.action = Action::check; }},
      {"--help", [](Options& options) { options.action = Action::help; }},
      {"-h", [](Options& options) { options.action = Action::help; }},
      {"--version", [](Options& options) { options.action = Action::version; }}};
  return all;
}

// Returns how many folders an action takes at most besides its subject.
std::size_t others_of(Options::Action action) {
  if (action == Options::Action::join) return static_cast<std::size_t>(kMostShards);
  return action == Options::Action::diff ? 1 : 0;
}

Status take_subject(Options& options, const std::string& word) {
  if (word.starts_with("-")) {
    std::vector<std::string> names;
    for (const auto& [name, set] : options_with_value()) names.push_back(name);
    for (const auto& [name, set] : flags()) names.push_back(name);
    return fail(Code::invalid_argument,
                "there is no option " + in_quotes(word) + "; there are " + listed(names));
  }
  if (options.subject.empty()) {
    options.subject = word;
    return ok();
  }
  if (options.others.size() == others_of(options.action))
    return fail(Code::invalid_argument,
                in_quotes(word) + " is one word too many after " +
                    in_quotes(options.others.empty() ? options.subject : options.others.back()));
  options.others.push_back(word);
  return ok();
}

Status take(Options& options, const std::vector<std::string>& words, std::size_t& i) {
  const std::string& word = words[i];
  if (const auto flag = flags().find(word); flag != flags().end()) {
    flag->second(options);
    return ok();
  }
  const auto option = options_with_value().find(word);
  if (option == options_with_value().end()) return take_subject(options, word);
  if (++i == words.size()) return fail(Code::invalid_argument, word + " needs a value after it");
  return option->second(options, words[i]);
}

const std::map<std::string, Options::Action>& commands() {
  using Action = Options::Action;
  static const std::map<std::string, Action> all{{"export", Action::table},
                                                 {"report", Action::report},
                                                 {"diff", Action::diff},
                                                 {"join", Action::join},
                                                 {"submit", Action::submit}};
  return all;
}

Status check_subjects(const Options& options) {
  using Action = Options::Action;
  if (options.action == Action::help || options.action == Action::version) return ok();
  if (options.action == Action::diff && options.others.empty())
    return fail(Code::invalid_argument,
                "diff needs the folders of two results, e.g. diff before.batch after.batch");
  if (options.action == Action::join && (options.subject.empty() || options.out.empty()))
    return fail(
        Code::invalid_argument,
        "join needs folders of results and one for all of them, e.g. join 1-of-2.batch 2-of-2.batch --out "
        "all.batch");
  if (options.action == Action::submit && !options.slurm)
    return fail(Code::invalid_argument, "submit needs --slurm: there is no other kind of cluster yet");
  if (!options.subject.empty()) return ok();
  return fail(Code::invalid_argument, options.action == Action::table
                                          ? "export needs the folder of the results"
                                          : "an experiment is needed, e.g. sim/experiments/avoid_office.xml");
}

}  // namespace

Result<Options> parse_options(const std::vector<std::string>& words) {
  Options options;
  options.batch.jobs = std::max(1U, std::thread::hardware_concurrency());
  const auto command = words.empty() ? commands().end() : commands().find(words.front());
  const bool is_command = command != commands().end();
  if (is_command) options.action = command->second;
  for (std::size_t i = is_command ? 1 : 0; i < words.size(); ++i)
    if (Status taken = take(options, words, i); !taken.ok()) return taken.error();
  if (Status checked = check_subjects(options); !checked.ok()) return checked.error();
  return options;
}

const char* help_text() {
  return R"(simbatch EXPERIMENT.xml [options]     run variants x worlds x seeds in simulated time, and compare them

  simbatch sim/experiments/avoid_office.xml              all runs, into the folder avoid_office.batch
  simbatch sim/experiments/avoid_office.xml --check      only say what is wrong with the experiment and its graphs
  simbatch sim/experiments/avoid_office.xml --resume     what is missing in the folder, never anything twice
  simbatch report sim/experiments/avoid_office.xml       the report once more, on the results that there are
  simbatch export avoid_office.batch                     one line for each run as CSV, in a fixed order
  simbatch sim/experiments/avoid_office.xml --shard 2/7  the second of seven parts, into avoid_office.2-of-7.batch
  simbatch join avoid_office.*-of-7.batch --out all      the parts together, as if one machine had made all
  simbatch submit sim/experiments/barn.xml --slurm       the parts as jobs of a Slurm cluster, and their join
  simbatch diff before.batch after.batch                 the first run that differs, and the first delivery in it that does

Each run is made in a process of its own, so one that crashes, hangs or takes too much memory costs no other; it is a result,
too. Ctrl-C and kill -9 lose nothing that was finished. The same experiment gives the same bytes, whatever --jobs and the
machine's load are.

The first run of each variant is made twice, the second time with other addresses, environment, process and folder. If the two
differ, a warning names the first delivery that does, and the batch goes on. A run that an overloaded machine does not let end
is no result: it is made again. --resume and join refuse results of other plugins, files or programs.

diff makes the first run that differs again, as both batches did, and watches all that its components receive: it names the
time, the component, the port and the values that differ.

submit queues an array with a part of the experiment in each task, and a job that joins them when all have ended, and shows how far
they are. A task that is cut off goes on where it was. Ctrl-C ends the looking on; with --resume it queues what is missing. sbatch
reads its own settings, such as SBATCH_PARTITION; programs, experiment and folder must be at the same place on all nodes.

  --out DIR             folder for results.sqlite, report.html and report.md (default: the experiment's name with .batch)
  --jobs N              runs at a time (default: as many as processors)
  --resume              go on with the results that DIR holds
  --shard I/N           only part I of N, for instance on N machines; every part has all variants of its worlds and seeds
  --slurm, --shards N   of submit: the kind of cluster, and the number of parts (default 16)
  --executor KIND       fiber (default) or baton
  --plugins FOLDER      look for plugins here too, after Orca's own; may be repeated
  --help, --version

Exit status: 0 done (runs that failed are results), 1 could not finish, 2 bad input, nothing was run.
Of diff: 0 the same, 1 different, 2 bad input.
docs/comparing.md explains experiments.
)";
}

}  // namespace orca::simbatch
