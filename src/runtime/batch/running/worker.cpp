// SPDX-License-Identifier: LGPL-3.0-or-later
#include "worker.hpp"

#include <sys/resource.h>
#include <unistd.h>

#include <array>
#include <cinttypes>
#include <cstdio>
#include <optional>
#include <string_view>

#include "orca/graph/loader.hpp"
#include "orca/host/catalogue.hpp"
#include "orca/host/run_system.hpp"

namespace orca::batch {
namespace {

// Writes all of it, or what the pipe takes: the other side tells a text that is not whole.
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

Ending ending_of(const host::RunResult& result) {
  if (result.outcome == host::RunOutcome::not_started) return Ending::failed;
  if (!result.contacts.empty()) return Ending::collision;
  if (!result.failures.empty()) return Ending::goal_failed;
  if (result.outcome == host::RunOutcome::finished) return Ending::success;
  return result.outcome == host::RunOutcome::time_is_up ? Ending::time_out : Ending::failed;
}

std::string reason_of(const host::RunResult& result) {
  return result.error ? result.error->text() : result.culprit;
}

Outcome outcome_of(const host::RunResult& result, const std::optional<double>& reference) {
  Outcome outcome;
  outcome.ending = ending_of(result);
  if (outcome.ending == Ending::failed) outcome.reason = reason_of(result);
  const bool arrives = outcome.ending == Ending::success && !result.arrivals.empty();
  RunEnd end{.succeeded = outcome.ending == Ending::success, .end = result.end, .reference = reference};
  if (arrives) end.end = to_time_point(result.arrivals.back().creation_time());
  if (!result.contacts.empty()) end.first_contact = to_time_point(result.contacts.front().stamp());
  outcome.time = to_seconds(end.end - result.start);
  outcome.goals = static_cast<std::uint32_t>(result.arrivals.size());
  outcome.failed_goals = static_cast<std::uint32_t>(result.failures.size());
  outcome.contacts = static_cast<std::uint32_t>(result.contacts.size());
  if (result.scene) {
    outcome.measures = measure(*result.scene, end);
    if (outcome.ending < Ending::failed) outcome.failure = failure_in(*result.scene, end);
    outcome.sketch = sketch_of(*result.scene);
  }
  if (result.trace_hash) outcome.trace_hash = hexadecimal(*result.trace_hash);
  return outcome;
}

// Hands the outcome over as soon as it is known.
class Reporter final : public host::RunListener {
 public:
  /// @param reference  [m] of the world.
  Reporter(int to, const std::optional<double>& reference) : to_(to), reference_(reference) {}
  void ended(const host::RunResult& result) override {
    write_all(to_, to_text(outcome_of(result, reference_)));
  }
  [[noreturn]] void abandon(const host::RunResult& result) override {
    ended(result);
    _exit(EXIT_SUCCESS);
  }

 private:
  const int to_;
  const std::optional<double> reference_;
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

}  // namespace

void work(const Experiment& experiment, const Run& run, const BatchOptions& options, int to) {
  limit_memory(experiment.memory_limit);
  host::StopSignal stop(EXIT_SUCCESS, EXIT_FAILURE, host::StopSignal::Terminal::ignored);
  host::PluginCatalogue catalogue(plugin::PluginIndex(options.plugin_folders), ClockKind::virtual_time);
  graph::LoadOptions load;
  load.settings = experiment.settings_of(run);
  load.any_link = true;
  xml::Diagnostics diagnostics;
  const std::optional<graph::Graph> graph =
      graph::load_file(experiment.variants[run.variant].graph, load, catalogue, diagnostics);
  if (!graph) {
    Outcome outcome{.ending = Ending::failed, .reason = diagnostics.text()};
    write_all(to, to_text(outcome));
    _exit(EXIT_SUCCESS);
  }
  host::RunOptions run_options;
  run_options.executive = {ClockKind::virtual_time, options.backend};
  run_options.seed = run.seed;
  run_options.until = experiment.until;
  run_options.keeps_motion = true;
  Reporter reporter(to, experiment.worlds[run.world].reference);
  (void)host::run_system(*graph, catalogue, run_options, stop, reporter);
  _exit(EXIT_SUCCESS);
}

}  // namespace orca::batch
