// SPDX-License-Identifier: GPL-3.0-or-later
// Additional permission: LICENSES/Orca-plugin-exception.txt
#include <unistd.h>

#include <cstdio>
#include <ctime>
#include <filesystem>
#include <optional>
#include <utility>

#include "common/arithmetic.hpp"
#include "common/output.hpp"
#include "difference.hpp"
#include "folders.hpp"
#include "options.hpp"
#include "orca/base/files/open_output.hpp"
#include "orca/base/live_line.hpp"
#include "orca/base/log.hpp"
#include "orca/base/output_file.hpp"
#include "orca/base/text.hpp"
#include "orca/batch/inputs.hpp"
#include "orca/batch/missing_runs.hpp"
#include "orca/batch/report.hpp"
#include "orca/batch/store.hpp"
#include "orca/batch/tuning.hpp"
#include "orca/xml/number.hpp"
#include "pack.hpp"
#include "progress.hpp"
#include "status.hpp"
#include "submission.hpp"
#include "tables.hpp"

namespace orca::simbatch {
namespace {

// Returns what shows on a terminal how far the check is; nothing elsewhere.
std::function<void(std::size_t, std::size_t)> check_watch() {
  if (isatty(STDERR_FILENO) == 0) return {};
  return [](std::size_t done, std::size_t all) {
    LiveLine::show(STDERR_FILENO,
                   "checking graph " + std::to_string(done + 1) + " of " + std::to_string(all));
  };
}

// Returns the experiment if it and its graphs have no fault; otherwise says all that is wrong.
std::optional<batch::Experiment> checked(const Options& options) {
  xml::Diagnostics diagnostics;
  std::optional<batch::Experiment> experiment = batch::read_parts(options.subject, diagnostics);
  if (experiment) batch::check_graphs(*experiment, options.batch, diagnostics, check_watch());
  LiveLine::erase();
  std::fputs(diagnostics.text().c_str(), stderr);
  return diagnostics.has_errors() ? std::nullopt : std::move(experiment);
}

// Returns "1 seed", "2 seeds".
std::string counted(std::size_t count, const std::string& what) {
  return std::to_string(count) + " " + what + (count == 1 ? "" : "s");
}

ExitCode check(const Options& options) {
  const std::optional<batch::Experiment> experiment = checked(options);
  if (!experiment) return ExitCode::bad_input;
  std::fprintf(stderr, "%s: no errors; %s, %s, %s: %s\n", options.subject.c_str(),
               counted(experiment->variants.size(), "variant").c_str(),
               counted(experiment->worlds.size(), "world").c_str(),
               counted(experiment->seeds.size(), "seed").c_str(),
               counted(experiment->run_count(), "run").c_str());
  return ExitCode::done;
}

Status write_file(const std::filesystem::path& file, const std::string& text) {
  OutputFile out("the result");
  if (const Status opened = out.open(file.string()); !opened.ok()) return opened;
  out.write(text);
  return out.close();
}

ExitCode could_not_write(const Status& written) {
  std::fprintf(stderr, "error: %s\n", written.error().text().c_str());
  return ExitCode::could_not_finish;
}

// Writes drawings and tables for a paper, and removes those of an earlier report, which may have had more.
Status write_files(const batch::Report& report, const std::filesystem::path& folder) {
  for (const auto& [name, end] :
       {std::pair("figures", ".svg"), std::pair("figures", ".pdf"), std::pair("tables", ".tex")}) {
    std::error_code error;
    std::filesystem::create_directories(folder / name, error);
    if (error) return fail(Code::unavailable, (folder / name).string() + ": " + error.message());
    for (const auto& old : std::filesystem::directory_iterator(folder / name))
      if (old.path().extension() == end) std::filesystem::remove(old.path(), error);
  }
  for (const auto& [name, text] : report.files)
    if (Status written = write_file(folder / name, text); !written.ok()) return written;
  return ok();
}

// Writes tables and report beside the results, and says the most important on stdout.
ExitCode report(const batch::Experiment& experiment, const batch::Store& store,
                const std::filesystem::path& folder) {
  const Result<batch::Report> made = batch::make_report(experiment, store);
  if (!made) return refuse(made.error());
  if (const Status written = write_tables(store, folder); !written.ok()) return could_not_write(written);
  for (const auto& [name, text] :
       {std::pair("report.html", made->html), std::pair("report.md", made->markdown),
        std::pair("provenance.json", batch::provenance_json(experiment, store))}) {
    if (const Status written = write_file(folder / name, text); !written.ok())
      return could_not_write(written);
  }
  if (const Status written = write_files(*made, folder); !written.ok()) return could_not_write(written);
  std::fputs(made->summary.c_str(), stdout);
  std::fputs(laps_summary(store).c_str(), stderr);
  std::fprintf(stderr, "report: %s\n", (folder / "report.html").c_str());
  return ExitCode::done;
}

std::string shard_text(const batch::Shard& shard, const char* between) {
  return std::to_string(shard.number) + between + std::to_string(shard.count);
}

std::filesystem::path folder_of(const Options& options, const batch::Experiment& experiment) {
  if (!options.out.empty()) return options.out;
  return experiment.name + (options.shard.count > 1 ? "." + shard_text(options.shard, "-of-") : "") +
         ".batch";
}

// Returns the time of now, "2026-11-28 21:40 UTC".
std::string date_of_now() {
  const std::time_t now = std::time(nullptr);
  std::tm parts{};
  gmtime_r(&now, &parts);
  char text[32];
  std::strftime(text, sizeof text, "%Y-%m-%d %H:%M UTC", &parts);
  return text;
}

// Keeps which build makes runs, from the first of them on.
Status declare_build(batch::Store& store) {
  return store.declare({{batch::kBuildDeclaration, build_text(), date_of_now()}});
}

// Keeps what the experiment asks, before anybody looks at an answer.
Status declare(const batch::Experiment& experiment, batch::Store& store) {
  return store.declare(batch::declarations_of(experiment, date_of_now()));
}

// Makes the report on results that are there, however many of the runs they are.
ExitCode report_again(const Options& options) {
  xml::Diagnostics diagnostics;
  const std::optional<batch::Experiment> experiment = batch::read_experiment(options.subject, diagnostics);
  std::fputs(diagnostics.text().c_str(), stderr);
  if (!experiment) return ExitCode::bad_input;
  const std::filesystem::path folder = folder_of(options, *experiment);
  if (!std::filesystem::exists(results_in(folder))) return refuse(no_results(folder.string()));
  const Result<std::unique_ptr<batch::Store>> store =
      batch::Store::open(results_in(folder).string(), batch::identity_of(*experiment));
  if (!store) return refuse(store.error());
  if (const Status declared = declare(*experiment, **store); !declared.ok()) return refuse(declared.error());
  return report(*experiment, **store, folder);
}

// Makes the runs that are missing. Returns why it could not make all; empty: it did.
std::string make_runs(const Options& options, const batch::Experiment& experiment, batch::Store& store) {
  batch::MissingRuns missing(experiment, store, options.shard);
  // A tuner only chooses: the comparison of what it has chosen makes runs twice.
  const bool chooses = options.action == Options::Action::tune;
  const std::vector<std::size_t> twice = chooses ? std::vector<std::size_t>{} : missing.not_repeated();
  Progress progress(experiment, store, missing.count_with(twice));
  const Result<batch::BatchEnd> end =
      batch::run_batch(experiment, {twice, [&] { return missing.next(); }}, options.batch, progress);
  progress.end();
  if (!end) return end.error().text();
  switch (*end) {
    case batch::BatchEnd::complete: return "";
    case batch::BatchEnd::stopped: return "stopped";
    case batch::BatchEnd::overloaded: return "the machine was overloaded, and some runs are missing";
  }
  return "";
}

// Hears what the runs of a batch depend on, before the first of them.
using Listener = std::function<void(const batch::Inputs&)>;

// Writes the best settings of each variant, and all draws.
ExitCode write_tuned(const batch::Experiment& experiment, const batch::Experiment& drawn,
                     const batch::Store& store, const std::filesystem::path& folder) {
  const std::vector<batch::Tuned> all = batch::judged(experiment, drawn, store);
  if (const Status written = write_file(folder / "draws.csv", batch::draws_table(all)); !written.ok())
    return could_not_write(written);
  for (const batch::Tuned& tuned : all) {
    const std::filesystem::path file = folder / (tuned.variant + ".xml");
    if (const Status written = write_file(file, batch::settings_file(tuned, experiment)); !written.ok())
      return could_not_write(written);
    std::printf("%s: %s\n", tuned.variant.c_str(), tuned.text(*experiment.tuning).c_str());
  }
  return ExitCode::done;
}

// Opens the folder for the results of an experiment, and keeps what they depend on.
Result<std::unique_ptr<batch::Store>> prepare(const Options& options, const batch::Experiment& experiment,
                                              const std::filesystem::path& folder, const Listener& listener,
                                              const std::vector<std::string>& written = names_of_report()) {
  if (std::filesystem::exists(results_in(folder)) && !options.resume)
    return fail(Code::already_exists, in_quotes(folder.string()) +
                                          " holds results already; --resume makes what is missing, "
                                          "--out DIR takes another folder");
  if (const Status free = check_free(folder, written); !free.ok()) return free.error();
  std::error_code error;
  if (const Status trusted = check_output_place(folder.string()); !trusted.ok())
    return fail(trusted.error().code, folder.string() + ": " + trusted.error().message);
  std::filesystem::create_directories(folder, error);
  if (error) return fail(Code::unavailable, folder.string() + ": " + error.message());
  Result<std::unique_ptr<batch::Store>> store = batch::Store::open(
      results_in(folder).string(), batch::identity_of(experiment),
      {std::filesystem::absolute(options.subject).lexically_normal().string(), options.plugins});
  if (!store) return store;
  const batch::Inputs inputs = batch::inputs_of(experiment);
  if (listener) listener(inputs);
  if (const Status kept = (*store)->keep(inputs); !kept.ok()) return kept.error();
  return store;
}

ExitCode did_not_finish(const std::string& fault) {
  std::fprintf(stderr, "error: %s; what was finished is kept, --resume goes on\n", fault.c_str());
  return ExitCode::could_not_finish;
}

// Tries values of what each variant may change, in worlds that the experiment does not compare in, and writes the best.
ExitCode tune(const Options& options) {
  xml::Diagnostics diagnostics;
  const std::optional<batch::Experiment> experiment = batch::read_parts(options.subject, diagnostics);
  const Result<batch::Experiment> drawn = diagnostics.has_errors()
                                              ? fail(Code::invalid_argument, "the experiment has errors")
                                              : batch::draws_of(*experiment);
  if (experiment)
    batch::check_graphs(drawn ? *drawn : *experiment, options.batch, diagnostics, check_watch());
  LiveLine::erase();
  std::fputs(diagnostics.text().c_str(), stderr);
  if (diagnostics.has_errors()) return ExitCode::bad_input;
  if (!drawn) return refuse(drawn.error());
  const std::filesystem::path folder = options.out.empty() ? experiment->name + ".tuned" : options.out;
  std::vector<std::string> written{"draws.csv"};
  for (const batch::Variant& variant : experiment->variants) written.push_back(variant.name + ".xml");
  Result<std::unique_ptr<batch::Store>> store = prepare(options, *drawn, folder, {}, written);
  if (!store) return refuse(store.error());
  if (const std::string fault = make_runs(options, *drawn, **store); !fault.empty())
    return did_not_finish(fault);
  return write_tuned(*experiment, *drawn, **store, folder);
}

ExitCode run(const Options& options, const Listener& listener = {}) {
  const std::optional<batch::Experiment> experiment = checked(options);
  if (!experiment) return ExitCode::bad_input;
  const std::filesystem::path folder = folder_of(options, *experiment);
  Result<std::unique_ptr<batch::Store>> store = prepare(options, *experiment, folder, listener);
  if (!store) return refuse(store.error());
  if (const Status declared = declare(*experiment, **store); !declared.ok()) return refuse(declared.error());
  if (const Status declared = declare_build(**store); !declared.ok()) return refuse(declared.error());
  if (const std::string fault = make_runs(options, *experiment, **store); !fault.empty())
    return did_not_finish(fault);
  if (options.shard.count == 1) return report(*experiment, **store, folder);
  std::fprintf(stderr, "part %s is in %s; simbatch join puts the parts together\n",
               shard_text(options.shard, " of ").c_str(), folder.c_str());
  return ExitCode::done;
}

ExitCode report_joined(const Options& options, const batch::Store& store) {
  if (const std::optional<batch::Experiment> experiment = experiment_of(store)) {
    const std::size_t missing = batch::MissingRuns(*experiment, store, {}).count();
    if (missing > 0)
      std::fprintf(stderr, "%zu of %zu runs are missing; --resume makes them\n", missing,
                   experiment->run_count());
    return report(*experiment, store, options.out);
  }
  std::fprintf(
      stderr,
      "the experiment is not here as it was; simbatch report EXPERIMENT.xml --out %s makes the report\n",
      options.out.c_str());
  return ExitCode::done;
}

Status take_all(batch::Store& store, const std::vector<std::string>& folders) {
  for (const std::string& folder : folders) {
    if (!std::filesystem::exists(results_in(folder))) return no_results(folder);
    if (Status taken = store.take_over(results_in(folder).string()); !taken.ok()) return taken;
  }
  return ok();
}

// Puts results together in a file that is there only when all went well.
ExitCode join(const Options& options) {
  const std::filesystem::path file = results_in(options.out);
  if (std::filesystem::exists(file))
    return refuse(fail(Code::already_exists,
                       in_quotes(options.out) + " holds results already; --out DIR takes another folder"));
  const Result<std::unique_ptr<batch::Store>> first = open_results(options.subject);
  if (!first) return refuse(first.error());
  if (const Status free = check_free(options.out, names_of_report()); !free.ok()) return refuse(free.error());
  if (const Status trusted = check_output_place(options.out); !trusted.ok())
    return refuse(fail(trusted.error().code, options.out + ": " + trusted.error().message));
  std::filesystem::create_directories(options.out);
  Result<std::unique_ptr<batch::Store>> all =
      batch::Store::open(file.string(), (*first)->identity(), (*first)->origin());
  if (!all) return refuse(all.error());
  std::vector<std::string> folders{options.subject};
  folders.insert(folders.end(), options.others.begin(), options.others.end());
  const Status taken = take_all(**all, folders);
  if (taken.ok()) return report_joined(options, **all);
  all->reset();
  for (const char* const end : {"", "-wal", "-shm"}) std::filesystem::remove(file.string() + end);
  return refuse(taken.error());
}

// Packs results that are complete, and were made with the files that are there now.
ExitCode pack(const Options& options) {
  const std::optional<batch::Experiment> experiment = checked(options);
  if (!experiment) return ExitCode::bad_input;
  const std::filesystem::path folder = folder_of(options, *experiment);
  const Result<std::unique_ptr<batch::Store>> store = open_results(folder);
  if (!store) return refuse(store.error());
  if ((*store)->identity() != batch::identity_of(*experiment))
    return refuse(fail(Code::failed_precondition,
                       in_quotes(folder.string()) + " holds results of another experiment than this one"));
  if (const Status kept = (*store)->keep(batch::inputs_of(*experiment)); !kept.ok())
    return refuse(kept.error());
  if (const std::size_t missing = batch::MissingRuns(*experiment, **store, {}).count(); missing > 0)
    return refuse(fail(Code::failed_precondition, std::to_string(missing) + " of " +
                                                      std::to_string(experiment->run_count()) +
                                                      " runs are missing; --resume makes them"));
  const Result<std::filesystem::path> archive =
      write_pack(*experiment, **store, folder, options.batch.plugin_folders);
  if (!archive) return refuse(archive.error());
  std::fprintf(stderr, "pack: %s\n", archive->c_str());
  return ExitCode::done;
}

// Returns the folder for a repetition, "avoid_office.repeat" for avoid_office.pack.tar.gz.
std::filesystem::path repeat_folder(const Options& options) {
  if (!options.out.empty()) return options.out;
  const std::string name = std::filesystem::path(options.subject).filename();
  return name.substr(0, name.find('.')) + ".repeat";
}

ExitCode repeat(const Options& options) {
  const std::filesystem::path folder = repeat_folder(options);
  const bool goes_on = options.resume && std::filesystem::exists(folder);
  const Result<Pack> pack = goes_on ? open_pack(folder) : unpack(options.subject, folder);
  if (!pack) return refuse(pack.error());
  Options again = options;
  again.subject = pack->experiment;
  again.out = folder / "batch";
  const ExitCode made = run(again, [&](const batch::Inputs& now) {
    const std::vector<std::string> others = other_programs(*pack, now);
    if (!others.empty())
      std::fprintf(stderr, "note: not built as for the pack: %s; the results show whether it matters\n",
                   listed(others).c_str());
  });
  return made == ExitCode::done ? compare_with(*pack, std::filesystem::path(again.out) / "runs.csv") : made;
}

ExitCode table(const Options& options) {
  const Result<std::unique_ptr<batch::Store>> store = open_results(options.subject);
  if (!store) return refuse(store.error());
  const Status read =
      runs_table(**store, [](std::string_view line) { std::fwrite(line.data(), 1, line.size(), stdout); });
  return read.ok() ? ExitCode::done : refuse(read.error());
}

ExitCode show_status(const Options& options) {
  const Result<std::unique_ptr<batch::Store>> store = open_results(options.subject);
  if (!store) return refuse(store.error());
  const std::optional<batch::Experiment> experiment = experiment_of(**store);
  if (!experiment)
    return refuse(fail(Code::failed_precondition, "the experiment is not there any more as it was",
                       (*store)->origin().file));
  const Result<std::string> status = status_json(*experiment, **store);
  if (!status) return refuse(status.error());
  std::fputs(status->c_str(), stdout);
  return ExitCode::done;
}

ExitCode act(const Options& options) {
  if (options.answer) {
    std::fputs(options.answer->c_str(), stdout);
    return ExitCode::done;
  }
  switch (options.action) {
    case Options::Action::check: return check(options);
    case Options::Action::table: return table(options);
    case Options::Action::report: return report_again(options);
    case Options::Action::status: return show_status(options);
    case Options::Action::diff: return diff(options);
    case Options::Action::join: return join(options);
    case Options::Action::submit: {
      const std::optional<batch::Experiment> experiment = checked(options);
      return experiment ? submit(options, *experiment) : ExitCode::bad_input;
    }
    case Options::Action::pack: return pack(options);
    case Options::Action::repeat: return repeat(options);
    case Options::Action::tune: return tune(options);
    case Options::Action::run: return run(options);
  }
  return ExitCode::bad_input;
}

// The word of a command that is not for people: this program starts itself so to make one run in other circumstances.
constexpr const char* kMakeAlone = "make-alone";

// Does what BatchOptions::alone asks for.
ExitCode make_alone(const std::vector<std::string>& words) {
  if (words.size() < 6) return ExitCode::bad_input;
  xml::Diagnostics unused;
  const std::optional<batch::Experiment> experiment = batch::read_experiment(words[1], unused);
  const Result<std::int64_t> number = xml::parse_integer(words[2]);
  const Result<std::int64_t> to = xml::parse_integer(words[3]);
  const Result<std::int64_t> trace = xml::parse_integer(words[4]);
  if (!experiment || !number || !to || !trace) return ExitCode::bad_input;
  batch::BatchOptions options;
  options.backend = words[5] == "baton" ? Backend::baton : Backend::fiber;
  options.plugin_folders.assign(words.begin() + 6, words.end());
  batch::make_alone(*experiment, static_cast<std::size_t>(*number), options, static_cast<int>(*to),
                    static_cast<int>(*trace));
}

}  // namespace
}  // namespace orca::simbatch

int main(int argc, char** argv) {
  using namespace orca::simbatch;
  orca::apps::choose_portable_arithmetic(argv);
  orca::log::set_level(orca::log::Level::off);
  const std::vector<std::string> words(argv + 1, argv + argc);
  if (!words.empty() && words.front() == kMakeAlone) return static_cast<int>(make_alone(words));
  if (words.size() > 1 && words.front() == kListFiles)
    return static_cast<int>(list_files({words.begin() + 1, words.end()}));
  orca::Result<Options> options = parse_options(words);
  if (!options) {
    std::fprintf(stderr, "error: %s\nsimbatch --help explains what there is\n",
                 options.error().message.c_str());
    return static_cast<int>(ExitCode::bad_input);
  }
  options->batch.alone = {"/proc/self/exe", kMakeAlone};
  options->batch = with_plugins(options->batch, options->plugins);
  const ExitCode code = act(*options);
  const bool lost = !orca::apps::output_has_arrived();
  return static_cast<int>(code == ExitCode::done && lost ? ExitCode::could_not_finish : code);
}
