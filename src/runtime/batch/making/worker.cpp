// SPDX-License-Identifier: LGPL-3.0-or-later
#include "worker.hpp"

#include <fcntl.h>
#include <malloc.h>
#include <sys/mman.h>
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cinttypes>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <optional>
#include <random>
#include <string>
#include <string_view>
#include <vector>

#include "orca/batch/localization.hpp"
#include "orca/batch/measures.hpp"
#include "orca/batch/record.hpp"
#include "orca/batch/referee.hpp"
#include "orca/graph/loader.hpp"
#include "orca/host/catalogue.hpp"
#include "orca/host/run_system.hpp"
#include "orca/idl/time.hpp"

namespace orca::batch {
namespace {

constexpr std::size_t kLargestBlock = 512;  // [bytes] of what a component keeps many of
constexpr std::size_t kBlocksEach = 1000;
constexpr std::size_t kMovedBy = 37UL << 20;  // [bytes]
constexpr int kFill = 0xa5;

// Writes all of it, or what the pipe takes: the other side recognises a text that is not whole.
void write_all(int to, std::string_view text) {
  while (!text.empty()) {
    const ssize_t written = ::write(to, text.data(), text.size());
    if (written <= 0) return;
    text.remove_prefix(static_cast<std::size_t>(written));
  }
}

std::string hexadecimal(std::uint64_t hash) {
  std::array<char, 17> digits{};
  std::snprintf(digits.data(), digits.size(), "%016" PRIx64, hash);
  return digits.data();
}

// Changes the environment of this process: where its home is, its time zone, the user's name and the size of the whole, which
// moves the stack. Variables that the dynamic linker, sanitizers and Orca's tests read stay. To be called in a copy of the
// process that is about to start another program.
void change_environment() {
  setenv("ORCA_ANOTHER_RUN", std::string(5000, 'x').c_str(), 1);
  setenv("HOME", "/", 1);
  setenv("USER", "somebody", 1);
  setenv("LOGNAME", "somebody", 1);
  setenv("TZ", "Pacific/Chatham", 1);
  unsetenv("PWD");
}

// Holes of each size between blocks that stay: the library hands the hole out first that became free last.
// Makes the next blocks of memory come in another order, at other addresses, and filled with another pattern, while there is
// no other thread.
void scramble_heap() {
  mallopt(M_PERTURB, kFill);
  std::minstd_rand random(1);  // the same each time, so that what is found once is found again
  std::vector<void*> holes;
  for (std::size_t size = 16; size <= kLargestBlock; size += 16) {
    for (std::size_t i = 0; i < 2 * kBlocksEach; ++i) {
      void* const block = std::malloc(size);
      if (i % 2 == 0) holes.push_back(block);
    }
  }
  std::shuffle(holes.begin(), holes.end(), random);
  for (void* const hole : holes) std::free(hole);
  // Later mappings lie elsewhere.
  (void)mmap(nullptr, kMovedBy, PROT_NONE, MAP_PRIVATE | MAP_ANONYMOUS | MAP_NORESERVE, -1, 0);
}

// The criteria that a run is judged by.
struct Criteria {
  std::vector<Goal> goals;
  bool has_task = false;
  std::optional<double> reference;  // [m] of the world
};

// Returns what components said of their goals, in the order of the times.
std::vector<GoalClaim> claims_of(const host::RunResult& result) {
  std::vector<GoalClaim> claims;
  for (const idl::Arrived& arrived : result.arrivals)
    claims.push_back({result.robots.of(arrived.origin()), to_time_point(arrived.creation_time()), true});
  for (const idl::GoalFailed& failed : result.failures)
    claims.push_back({result.robots.of(failed.origin()), to_time_point(failed.creation_time()), false});
  std::ranges::stable_sort(claims, {}, &GoalClaim::time);
  return claims;
}

// Returns the judgement of a run without goals: what components say.
Judgement own_word(const host::RunResult& result) {
  Judgement judgement{.reached = static_cast<std::uint32_t>(result.arrivals.size()),
                      .missed = static_cast<std::uint32_t>(result.failures.size())};
  judgement.claimed = judgement.reached;
  if (result.outcome == host::RunOutcome::finished && judgement.missed == 0)
    judgement.done =
        result.arrivals.empty() ? result.end : to_time_point(result.arrivals.back().creation_time());
  return judgement;
}

// A task may drive elsewhere between its goals, and give one up for another.
Result<Judgement> judgement_of_task(const host::RunResult& result, const std::vector<Goal>& goals) {
  Result<Judgement> judgement = judge_goals(goals, result.scene.value_or(Scene{}), {}, result.end);
  if (judgement && result.outcome != host::RunOutcome::finished) judgement->done.reset();
  return judgement;
}

Result<Judgement> judgement_of(const host::RunResult& result, const Criteria& criteria) {
  const std::vector<Goal>& goals = criteria.goals;
  if (goals.empty()) return own_word(result);
  if (criteria.has_task) return judgement_of_task(result, goals);
  return judge_goals(goals, result.scene.value_or(Scene{}), claims_of(result), result.end);
}

// A component fails, too, if it has given a goal up; that is no crash.
Ending ending_of(const host::RunResult& result, const Judgement& judgement) {
  if (result.outcome == host::RunOutcome::not_started) return Ending::failed;
  if (!result.contacts.empty()) return Ending::contact;
  if (result.outcome == host::RunOutcome::failed && result.failures.empty()) return Ending::failed;
  if (judgement.done) return Ending::success;
  if (judgement.missed > 0 || judgement.claimed_wrongly > 0) return Ending::goal_failed;
  if (result.outcome == host::RunOutcome::time_is_up) return Ending::time_out;
  const bool is_over =
      result.outcome == host::RunOutcome::finished || result.outcome == host::RunOutcome::failed;
  return is_over ? Ending::goal_failed : Ending::failed;
}

PoseClaim::Says said_by(const idl::Localization& belief) {
  if (belief.places().empty()) return PoseClaim::Says::nothing;
  switch (belief.state()) {
    case idl::LOCALIZATION_LOCALIZED: return PoseClaim::Says::place;
    case idl::LOCALIZATION_AMBIGUOUS: return PoseClaim::Says::several;
    default: return PoseClaim::Says::nothing;
  }
}

std::vector<PoseClaim> poses_claimed(const host::RunResult& result) {
  std::vector<PoseClaim> claims;
  for (const idl::Localization& belief : result.localizations) {
    PoseClaim& claim =
        claims.emplace_back(PoseClaim{result.robots.of(belief.origin()), to_time_point(belief.stamp())});
    claim.says = said_by(belief);
    if (claim.says != PoseClaim::Says::place) continue;
    const idl::Pose2D& place = belief.places()[0];
    claim.X_WR = {place.x(), place.y(), place.orientation()};
  }
  return claims;
}

void add_localization(const host::RunResult& result, Measures& measures) {
  const LocalizationShares shares = judge_poses(poses_claimed(result), *result.scene);
  measures.noticed = shares.noticed;
  measures.found_again = shares.found_again;
  measures.sure_but_wrong = shares.sure_but_wrong;
  measures.ambiguous = shares.ambiguous;
}

// A planner raises this alarm each time (orca/planning/recoveries.hpp).
double recoveries_in(const host::RunResult& result) {
  return static_cast<double>(std::ranges::count_if(result.alarms, [](const idl::Alarm& alarm) {
    return alarm.active() && alarm.kind() == idl::OWN_KIND && alarm.own_kind() == "RECOVERS";
  }));
}

std::string reason_of(const host::RunResult& result) {
  return result.error ? result.error->text() : result.culprit;
}

void add_scene(const host::RunResult& result, const RunEnd& end, Outcome& outcome) {
  Measures measures = measure(*result.scene, end);
  measures.claimed = outcome.measures.claimed;
  measures.claimed_wrongly = outcome.measures.claimed_wrongly;
  measures.not_claimed = outcome.measures.not_claimed;
  add_localization(result, measures);
  measures.recoveries = recoveries_in(result);
  outcome.measures = measures;
  if (outcome.ending < Ending::failed) outcome.failure = failure_in(*result.scene, end);
  outcome.sketch = sketch_of(*result.scene);
}

Outcome outcome_of(const host::RunResult& result, const Criteria& criteria) {
  Outcome outcome;
  const Result<Judgement> judged = judgement_of(result, criteria);
  const Judgement judgement = judged ? *judged : Judgement{};
  outcome.ending = judged ? ending_of(result, judgement) : Ending::failed;
  if (outcome.ending == Ending::failed) {
    outcome.reason = judged || result.error ? reason_of(result) : judged.error().message;
    outcome.failure = Failure::crash;
  }
  RunEnd end{
      .succeeded = outcome.ending == Ending::success, .end = result.end, .reference = criteria.reference};
  end.lost = judgement.claimed_wrongly > 0;
  end.overload = std::ranges::any_of(
      result.counters.computing, [](const auto& one) { return 2 * one.second.overruns > one.second.laps; });
  if (end.succeeded) end.end = *judgement.done;
  if (!result.contacts.empty()) end.first_contact = to_time_point(result.contacts.front().stamp());
  outcome.time = to_seconds(end.end - result.start);
  outcome.goals = judgement.reached;
  outcome.failed_goals = judgement.missed;
  outcome.contacts = static_cast<std::uint32_t>(result.contacts.size());
  if (!criteria.has_task) outcome.measures.claimed = judgement.claimed;
  if (!criteria.goals.empty() && !criteria.has_task) {
    outcome.measures.claimed_wrongly = judgement.claimed_wrongly;
    outcome.measures.not_claimed = judgement.not_claimed;
  }
  if (result.scene) add_scene(result, end, outcome);
  if (result.trace_hash) outcome.trace_hash = hexadecimal(*result.trace_hash);
  return outcome;
}

std::vector<LapCost> laps_of(const host::RunResult& result) {
  static_assert(host::LapTimes::kQuantiles == 21);
  std::vector<LapCost> laps;
  for (const auto& [component, times] : result.lap_times)
    if (times.laps > 0)
      laps.push_back({component, times.laps, times.total / static_cast<double>(times.laps),
                      times.quantiles[19], times.quantiles.back()});
  return laps;
}

// Hands the outcome over as soon as it is known.
class Reporter final : public host::RunListener {
 public:
  Reporter(int to, Criteria criteria) : to_(to), criteria_(std::move(criteria)) {}
  void ended(const host::RunResult& result) override {
    write_all(to_, to_text(outcome_of(result, criteria_)) + kLapsFollow + laps_text(laps_of(result)));
  }
  [[noreturn]] void abandon(const host::RunResult& result) override {
    ended(result);
    _exit(EXIT_SUCCESS);
  }

 private:
  const int to_;
  const Criteria criteria_;
};

// Sanitizers take terabytes of addresses for themselves.
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
constexpr bool kMayLimitMemory = false;
#else
constexpr bool kMayLimitMemory = true;
#endif

void limit_memory(std::uint64_t bytes) {
  const rlimit limit{bytes, bytes};
  if (kMayLimitMemory) (void)setrlimit(RLIMIT_AS, &limit);
}

void go_elsewhere() {
  if (chdir("/") != 0) _exit(EXIT_FAILURE);
  scramble_heap();
}

host::RunOptions run_options(const Experiment& experiment, const Run& run, const BatchOptions& options,
                             const WorkPlan& plan) {
  host::RunOptions wanted;
  wanted.executive = {ClockKind::virtual_time, options.backend};
  wanted.seed = run.seed;
  wanted.until = experiment.until;
  wanted.computing = experiment.variants[run.variant].computing;
  wanted.measures_laps = true;
  wanted.keeps_motion = true;
  for (const Failing& one : experiment.worlds[run.world].failing)
    if (const auto failure = host::failure_from(one.how))
      wanted.planned_failures.push_back({one.component, *failure, one.time(run.seed)});
  if (plan.trace >= 0) wanted.trace_file = "/proc/self/fd/" + std::to_string(plan.trace);
  wanted.trace_values = true;
  return wanted;
}

}  // namespace

void work(const Experiment& experiment, const Run& run, const BatchOptions& options, const WorkPlan& plan) {
  limit_memory(experiment.memory_limit);
  host::StopSignal stop(EXIT_SUCCESS, EXIT_FAILURE, host::StopSignal::Terminal::ignored);
  host::PluginCatalogue catalogue(plugin::PluginIndex(options.plugin_folders), ClockKind::virtual_time);
  graph::LoadOptions load;
  load.profiles = experiment.variants[run.variant].profiles;
  load.settings = experiment.settings_of(run);
  load.any_link = true;
  xml::Diagnostics diagnostics;
  const std::optional<graph::Graph> graph =
      graph::load_file(experiment.variants[run.variant].graph, load, catalogue, diagnostics);
  if (!graph) {
    const Outcome outcome{.ending = Ending::failed, .reason = diagnostics.text(), .failure = Failure::crash};
    write_all(plan.to, to_text(outcome));
    _exit(EXIT_SUCCESS);
  }
  if (plan.elsewhere) go_elsewhere();  // not before: relative paths of the graph start at the current folder
  Reporter reporter(plan.to,
                    {experiment.goals_of(run), experiment.has_task, experiment.worlds[run.world].reference});
  (void)host::run_system(*graph, catalogue, run_options(experiment, run, options, plan), stop, reporter);
  _exit(EXIT_SUCCESS);
}

void work_elsewhere(const Experiment& experiment, std::size_t number, const BatchOptions& options,
                    const WorkPlan& plan) {
  for (const int inherited : {plan.to, plan.trace}) (void)fcntl(inherited, F_SETFD, 0);
  std::vector<std::string> words = options.alone;
  words.insert(words.end(), {std::filesystem::absolute(experiment.file).string(), std::to_string(number),
                             std::to_string(plan.to), std::to_string(plan.trace),
                             options.backend == Backend::baton ? "baton" : "fiber"});
  words.insert(words.end(), options.plugin_folders.begin(), options.plugin_folders.end());
  std::vector<char*> arguments;
  for (std::string& word : words) arguments.push_back(word.data());
  arguments.push_back(nullptr);
  change_environment();
  execv(arguments[0], arguments.data());
  _exit(EXIT_FAILURE);
}

void make_alone(const Experiment& experiment, std::size_t number, const BatchOptions& options, int to,
                int trace) {
  work(experiment, experiment.run(number), options, {.to = to, .trace = trace, .elsewhere = true});
}

}  // namespace orca::batch
