// SPDX-License-Identifier: LGPL-3.0-or-later
#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <utility>

#include "announcer.hpp"
#include "containment/environment.hpp"
#include "containment/stall_monitor.hpp"
#include "orca/host/run_system.hpp"
#include "orca/host/stop_signal.hpp"
#include "system.hpp"

namespace orca::host {
namespace {

constexpr Duration kStartLimit = 10s;
constexpr Duration kRestLimit = 1s;
constexpr Duration kTakeDownLimit = 1500ms;

// One run, from bringing up to taking down. Its main() is the executive's main task.
class Run {
 public:
  Run(const graph::Graph& graph, PluginCatalogue& catalogue, const RunOptions& options, Executive& executive,
      StopSignal& stop)
      : graph_(graph),
        catalogue_(catalogue),
        options_(options),
        executive_(executive),
        stop_(stop),
        trace_(executive),
        start_(executive.now()),
        announcer_(start_) {}

  ExitCode execute() {
    if (!options_.trace_file.empty())
      if (const Status opened = trace_.open(options_.trace_file); !opened.ok()) return refuse(opened.error());
    if (const Status built = system_.build(catalogue_); !built.ok()) return refuse(built.error());
    executive_.run([this] { main(); });
    finish_output();
    return code_;
  }

 private:
  static ExitCode refuse(const Error& error) {
    log::error("deployer", error.text());
    return ExitCode::could_not_start;
  }

  void main() {
    stop_.on_request([this] { changed_->notify(); });
    const Status up = system_.bring_up(*changed_, executive_.now() + kStartLimit);
    if (!up.ok() && !stop_.requested()) {
      code_ = refuse(up.error());
      log::error("deployer", "not everything came up; taking all down again");
    } else {
      system_.open_gates();
      supervise();
      if (has_ended() && !stop_.requested()) wait_for_rest();
    }
    take_down();
    stop_.on_request(nullptr);
  }

  void supervise() {
    const TimePoint end = options_.until ? executive_.now() + *options_.until : kForever;
    while (!stop_.requested() && executive_.now() < end && !has_ended()) {
      if (!changed_->wait_until(end) && end == kForever && executive_.is_virtual() && !stop_.requested()) {
        log::error("deployer", "nothing can ever happen again: all components wait for each other");
        code_ = ExitCode::failed_running;
        return;
      }
    }
  }

  // Whether the components that the graph names in `ends` have come to an end; decides the exit code.
  bool has_ended() {
    bool all_done = !graph_.ends.empty();
    for (const std::string& name : graph_.ends) {
      const ComponentInstance& component = *system_.component(name);
      if (component.has_failed()) {
        code_ = ExitCode::failed_running;
        return true;
      }
      all_done = all_done && component.state() == ComponentState::work_done;
    }
    return all_done;
  }

  // Lets the closing phase run its course: the last client has gone, connections close down to the hardware.
  void wait_for_rest() {
    const TimePoint limit = executive_.now() + kRestLimit;
    while (!system_.at_rest() && executive_.now() < limit && !stop_.requested()) changed_->wait_until(limit);
  }

  void take_down() {
    const std::vector<std::string> stuck = system_.take_down(executive_.now() + kTakeDownLimit);
    if (stuck.empty()) return;
    for (const std::string& name : stuck)
      log::error("deployer", name + " does not end; the process is ended without it");
    if (executive_.is_virtual()) announcer_.print_trace_hash(trace_.hash());
    std::fflush(nullptr);
    std::_Exit(static_cast<int>(ExitCode::failed_running));  // its thread cannot be ended in any other way
  }

  void finish_output() {
    if (!options_.picture.file.empty()) draw();
    const bool ran = code_ != ExitCode::could_not_start;  // what never ran is equal to nothing
    if (ran && executive_.is_virtual()) announcer_.print_trace_hash(trace_.hash());
  }

  void draw() {
    Scene scene;
    scene.start = start_;
    system_.draw(scene);
    announcer_.draw(scene);
    if (const Status drawn = write_picture(scene, options_.picture); !drawn.ok())
      log::error("deployer", drawn.error().text());
  }

  const graph::Graph& graph_;
  PluginCatalogue& catalogue_;
  const RunOptions& options_;
  Executive& executive_;
  StopSignal& stop_;
  Trace trace_;
  const TimePoint start_;
  Announcer announcer_;
  std::unique_ptr<Event> changed_ = executive_.make_event();
  RunContext context_{executive_,
                      trace_,
                      options_.seed.value_or(graph_.seed.value_or(1)),
                      [this](const Announcement& a) { announcer_.announce(a); },
                      [this] { changed_->notify(); },
                      !options_.picture.file.empty()};
  System system_{graph_, context_, [this] { return stop_.requested(); }};
  ExitCode code_ = ExitCode::finished;
};

}  // namespace

ExitCode run_system(const graph::Graph& graph, PluginCatalogue& catalogue, const RunOptions& options,
                    StopSignal& stop) {
  Result<std::unique_ptr<Executive>> executive = make_executive(options.executive);
  if (!executive) {
    log::error("deployer", executive.error().text());
    return ExitCode::bad_input;
  }
  const TimePoint start = (*executive)->now();
  log::set_clock([clock = executive->get(), start] { return TimePoint(clock->now() - start); });
  ExitCode code = ExitCode::finished;
  {
    const StallMonitor monitor(**executive);
    const KeptEnvironment environment;
    code = Run(graph, catalogue, options, **executive, stop).execute();
  }
  log::set_clock(nullptr);
  return code;
}

}  // namespace orca::host
