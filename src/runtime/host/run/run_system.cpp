// SPDX-License-Identifier: LGPL-3.0-or-later
#include "orca/host/run_system.hpp"

#include <algorithm>
#include <cstdio>
#include <exception>
#include <map>
#include <memory>
#include <optional>
#include <vector>

#include "orca/base/exhaustion.hpp"
#include "orca/base/system/task_time.hpp"
#include "orca/base/text.hpp"
#include "orca/graph/port_list.hpp"
#include "orca/graph/print.hpp"
#include "orca/host/conclusion.hpp"
#include "orca/host/edge_choice.hpp"
#include "orca/host/idleness.hpp"
#include "orca/host/last_words.hpp"
#include "orca/host/robot_finder.hpp"
#include "part/open_run.hpp"
#include "recording/run_files.hpp"
#include "swap/rewiring.hpp"
#include "swap/timed_changes.hpp"
#include "system/live_view.hpp"
#include "system/peer_calls.hpp"
#include "system/system.hpp"
#include "system/watched_system.hpp"

namespace orca::host {
namespace {

constexpr Duration kRestLimit = 1s;

std::string hash_text(std::uint64_t hash) {
  char text[17];
  std::snprintf(text, sizeof text, "%016llx", static_cast<unsigned long long>(hash));
  return text;
}

std::string restless_text(const std::vector<std::string>& names, Duration instant) {
  char time[32];
  std::snprintf(time, sizeof time, "%.6g s", to_seconds(instant));
  return "virtual time stands still at " + std::string(time) + ": " + listed(names) +
         (names.size() == 1 ? " goes" : " go") + " on at this instant without end (" +
         std::to_string(Executive::kMostTurns) +
         " turns so far); one of them must let time pass, for example work by period";
}

// One run, from bringing up to taking down. Its main() is the executive's main task.
class Run {
 public:
  Run(const graph::Graph& graph, PluginCatalogue& catalogue, const RunOptions& options, Executive& executive,
      StopSignal& stop, RunListener& listener)
      : graph_(graph),
        catalogue_(catalogue),
        options_(options),
        stop_(stop),
        listener_(listener),
        files_(executive),
        watched_(graph, {catalogue, executive, files_.trace(), listener}, wishes(),
                 [this] { return stop_.requested(); }) {}

  /// Runs, reports the end, and destroys all instances.
  RunResult execute() {
    run();
    close_outputs();
    RunResult result = this->result();
    listener_.ended(result);  // before the destructors of plugins, which may end the process
    watched_.destroy();
    reporter().fill(result);
    return result;
  }

 private:
  void run() {
    const auto ports = options_.recordings.empty() ? std::vector<graph::ListedPort>{}
                                                   : graph::list_ports(graph_, catalogue_);
    const BagOrigin origin = options_.recordings.empty() ? BagOrigin{} : bag_origin(ports);
    if (const Status opened = files_.open(options_, ports, origin); !opened.ok())
      return refuse_output(opened.error());
    if (options_.visitors != nullptr) make_door();
    if (options_.looks_on) reporter().look_on(view_.sightings());
    if (!options_.recordings.empty()) reporter().record(files_.recorder());
    if (options_.keeps_motion) reporter().keep_localizations();
    if (const Status built = watched_.build(); !built.ok()) return conclusion_.report_failure(built.error());
    reporter().introduce(find_robots(graph_, system().robots()));
    if (options_.looks_on) listener_.built(view_);
    if (door_) door_->open();
    watched_.run([this] { main(); }, [this](const std::string& component,
                                            const std::string& text) { stand_still(component, text); });
    if (door_) door_->leave();
    if (!options_.picture.file.empty()) draw();
    if (options_.keeps_motion) scene_ = watched_.scene();
  }

  void make_door() {
    door_.emplace(OpenRun::Parts{graph_, watched_, changes_.swaps(), [this] { stop_motors(); }},
                  *options_.visitors);
  }

  [[nodiscard]] BagOrigin bag_origin(const std::vector<graph::ListedPort>& ports) const {
    return {graph_.name,
            graph::print(graph_),
            {{"graph.json", graph::graph_json(graph_)}, {"ports.json", graph::ports_json(ports)}},
            {{"seed", std::to_string(options_.seed.value_or(1))}}};
  }

  void refuse_output(const Error& error) {
    const bool wrong = error.code == Code::invalid_argument || error.code == Code::already_exists;
    reporter().log_error(error.text());
    conclusion_.conclude(wrong ? RunOutcome::bad_options : RunOutcome::not_started, error);
  }

  void close_outputs() {
    if (executive().is_virtual())
      files_.recorder().conclude({{"trace-hash", hash_text(files_.trace().hash())}});
    for (const Error& error : files_.close()) fail_output(error);
  }

  // What people asked for is not there, so the run has failed, however well it went.
  void fail_output(const Error& error) {
    reporter().log_error(error.text());
    conclusion_.fail_late(error);
  }

  void main() {
    stop_.on_request([this] { watched_.changed().notify(); });
    stop_.on_crash([this] { stop_motors(); });
    const Status up = bring_up();
    if (!up.ok() && !stop_.requested()) {
      conclusion_.refuse_start(up.error());
    } else {
      // After a request to stop, some components may not be up, and others would fail for want of them.
      LastWords::catch_exit();
      const bool opens = up.ok() && !stop_.requested();
      if (opens) conclusion_.came_up();
      if (opens) system().open_gates();
      if (opens && door_) door_->came_up();
      supervise();
      if (door_) door_->hurry();  // what ends takes time
      if (conclusion_.has_closing_phase() && !stop_.requested()) wait_for_rest();
      if (opens) sum_up();
    }
    take_down();
    stop_.on_request(nullptr);
    stop_.on_crash(nullptr);
  }

  Status bring_up() {
    try {
      return system().bring_up(watched_.changed(), executive().now() + kStartLimit);
    } catch (...) {
      const char* const text = exhaustion_text(std::current_exception());
      if (text == nullptr) throw;
      return fail(Code::unavailable, text);
    }
  }

  // Another thread is about to end the process.
  void stop_motors() {
    watched_.stop_motors();
    files_.close_at_once();
  }

  void supervise() {
    const TimePoint end = options_.until ? executive().now() + *options_.until : kForever;
    changes_.begin();
    bool all_wait = false;
    while (!stop_.requested() && executive().now() < end && !has_ended() && !report_standstill(all_wait)) {
      if (door_ && door_->obey()) return conclusion_.stop("");
      choose_edges();
      carry_out_peer_orders(watched_);
      const Result<TimePoint> next = changes_.go_on();
      if (!next) return conclusion_.report_failure(next.error());
      const TimePoint until = std::min(end, *next);
      all_wait = !watched_.changed().wait_until(until) && until == kForever && executive().is_virtual();
    }
    if (has_ended()) return;
    stop_.requested() ? conclusion_.stop(stop_.failure()) : conclusion_.run_out_of_time();
  }

  // Moves ports whose server is not up any more to another one.
  void choose_edges() {
    const auto standings = [this](const std::string& name) { return standing_of(reports_(name)); };
    for (const EdgeChoice::Move& move : choice_.look(standings)) {
      reporter().log(log::Level::warning, move.edge->client().component, move.text);
      (void)host::move(system(), *move.edge);
    }
  }

  // Reports that virtual time cannot pass any more, and returns whether that is so.
  // @param all_wait  no component can ever run again.
  bool report_standstill(bool all_wait) {
    const std::vector<std::string> restless = executive().restless_tasks();
    stands_still_ = all_wait;
    if (!restless.empty()) {
      conclusion_.report_failure(
          fail(Code::deadline_exceeded, restless_text(restless, executive().now() - start_)));
    } else if (all_wait) {
      conclusion_.report_failure(
          fail(Code::internal, "nothing can ever happen again: all components wait for each other"));
    }
    return all_wait || !restless.empty();
  }

  // Returns whether the run has come to its end.
  bool has_ended() {
    if (!conclusion_.is_over()) conclusion_.look_at_ends();
    return conclusion_.is_over();
  }

  // Says what did not happen, and decides whether the run has failed. To be called before it is taken down, which
  // makes other components fail.
  void sum_up() {
    counters_ = collect_counters(graph_, system());
    if (const Status changed = changes_.finish(); !changed.ok() && !conclusion_.has_failed())
      conclusion_.report_failure(changed.error());
    if (stands_still_ || (!conclusion_.has_failed() && executive().now() - start_ >= kShortRun))
      report_idleness();
    conclusion_.judge();
  }

  void report_idleness() {
    for (const auto& [who, text] : find_idleness(graph_, reports_, *counters_))
      reporter().log(log::Level::warning, who.empty() ? options_.log_name : who, text);
  }

  // Waits for the closing phase: the last client has gone, and connections close down to the hardware.
  void wait_for_rest() {
    const TimePoint limit = executive().now() + kRestLimit;
    while (!system().at_rest() && executive().now() < limit && !stop_.requested() &&
           executive().restless_tasks().empty())
      watched_.changed().wait_until(limit);
  }

  // Whatever the connections refuse and leave behind from here on is no trouble, and is not counted.
  void take_down() {
    end_ = executive().now();
    if (door_) door_->close();
    reporter().ignore_trouble();
    if (!counters_) counters_ = collect_counters(graph_, system());
    const std::vector<std::string> stuck = system().take_down(executive().now() + kTakeDownLimit);
    changes_.give_up();
    if (stuck.empty()) return take_lap_times();
    for (const std::string& name : stuck)
      reporter().log_error(name + " does not end; the process is ended without it");
    conclusion_.fail_with(
        fail(Code::deadline_exceeded, listed(stuck) + (stuck.size() == 1 ? " does" : " do") + " not end"));
    close_outputs();
    listener_.abandon(result());  // a thread cannot be ended in any other way
  }

  void take_lap_times() {
    for (const auto& component : system().components().all())
      if (const auto& meter = component->parts().meter) lap_times_[component->name()] = meter->summary();
  }

  // Reports a standstill. It runs on the monitor's own thread, because no strand can run.
  void stand_still(const std::string& component, const std::string& text) {
    reporter().log(log::Level::error, component, text);
    RunResult ended = result();
    ended.outcome = conclusion_.has_come_up() ? RunOutcome::failed : RunOutcome::not_started;
    ended.culprit = component;
    ended.error = fail(Code::deadline_exceeded, text, component);
    ended.trace_hash.reset();  // it would depend on the moment at which the standstill was noticed
    files_.close_at_once();
    listener_.abandon(ended);
  }

  void draw() {
    const Status drawn = write_picture(watched_.scene(), options_.picture, files_.picture());
    if (!drawn.ok()) fail_output(drawn.error());
  }

  [[nodiscard]] SystemOptions wishes() const {
    return {.seed = options_.seed.value_or(1),
            .scene = {.moments = !options_.picture.file.empty(), .motion = options_.keeps_motion},
            .failures = options_.planned_failures,
            .log_name = options_.log_name,
            .computing = options_.computing,
            .measures_laps = options_.measures_laps};
  }
  [[nodiscard]] Executive& executive() const { return watched_.executive(); }
  [[nodiscard]] System& system() { return watched_.system(); }
  [[nodiscard]] Reporter& reporter() { return watched_.reporter(); }

  [[nodiscard]] RunResult result() const {
    RunResult result;
    conclusion_.fill(result);
    // Without a start there is nothing to compare.
    const bool ran = result.outcome != RunOutcome::not_started && result.outcome != RunOutcome::bad_options;
    if (ran && executive().is_virtual()) result.trace_hash = files_.trace().hash();
    watched_.reporter().fill(result);
    result.end = end_.value_or(executive().now());
    result.ways = view_.sightings().ways();
    result.scene = scene_;
    result.lap_times = lap_times_;
    if (ran) result.counters = counters_ ? *counters_ : collect_counters(graph_, watched_.system());
    return result;
  }

  graph::Graph graph_;  // as it is now
  PluginCatalogue& catalogue_;
  const RunOptions& options_;
  StopSignal& stop_;
  RunListener& listener_;
  RunFiles files_;
  WatchedSystem watched_;
  const TimePoint start_ = watched_.start();
  LiveView view_{executive(), start_, watched_.system(), watched_.reporter()};
  const Reports reports_ = [this](const std::string& name) { return system().component(name)->report(); };
  Conclusion conclusion_{graph_, reports_, options_.log_name,
                         [this](log::Level level, const std::string& who, const std::string& text) {
                           reporter().log(level, who, text);
                         }};
  EdgeChoice choice_{graph_};
  TimedChanges changes_{graph_, watched_, catalogue_, executive(), options_.changes};
  std::optional<OpenRun> door_;                // for visitors, if there are any
  std::optional<Scene> scene_;                 // after the end
  std::optional<TimePoint> end_;               // when the taking down began
  std::optional<RunCounters> counters_;        // of the run until it was taken down
  std::map<std::string, LapTimes> lap_times_;  // of components whose strands have ended
  bool stands_still_ = false;                  // nothing could ever happen again
};

RunResult refuse_options(const Error& error, const RunOptions& options) {
  log::error(options.log_name, error.text());
  RunResult result;
  result.outcome = RunOutcome::bad_options;
  result.error = error;
  return result;
}

}  // namespace

RunResult run_system(const graph::Graph& graph, PluginCatalogue& catalogue, const RunOptions& options,
                     StopSignal& stop, RunListener& listener) {
  if (options.measures_laps) tell_tasks_apart();
  Result<std::unique_ptr<Executive>> executive =
      options.visitors != nullptr ? make_paced_executive(options.executive, options.visitors->pace())
                                  : make_executive(options.executive);
  if (!executive) return refuse_options(executive.error(), options);
  const TimePoint start = (*executive)->now();
  log::set_clock([clock = executive->get(), start] { return TimePoint(clock->now() - start); });
  RunResult result = Run(graph, catalogue, options, **executive, stop, listener).execute();
  log::set_clock(nullptr);
  return result;
}

}  // namespace orca::host
