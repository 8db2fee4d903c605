// SPDX-License-Identifier: LGPL-3.0-or-later
#include "watched_system.hpp"

#include <utility>

#include "containment/stall_monitor.hpp"
#include "orca/base/activity.hpp"

namespace orca::host {
namespace {

constexpr Duration kMotorLimit = 150ms;

}  // namespace

WatchedSystem::WatchedSystem(const graph::Graph& graph, const SystemPlace& place,
                             const SystemOptions& options, std::function<bool()> give_up)
    : place_(place),
      reporter_(place.executive, place.trace, place.listener, options.log_name),
      environment_(place.executive.tasks_overlap(), [this](const idl::Alarm& alarm) { raise(alarm); }),
      context_{place.executive,
               place.trace,
               reporter_,
               options.seed,
               [this] { changed_->notify(); },
               options.missions != nullptr ? *options.missions : missions_,
               options.scene,
               options.failures,
               options.doorbell,
               options.state_sink,
               options.states,
               options.computing,
               options.measures_laps,
               options.run},
      system_(std::in_place, graph, context_, std::move(give_up)) {
  place_.catalogue.on_alarm([this](const idl::Alarm& alarm) { reporter_.raise(alarm); });
}

WatchedSystem::~WatchedSystem() { place_.catalogue.on_alarm(nullptr); }

void WatchedSystem::run(std::function<void()> main, const Standstill& standstill) {
  const StallMonitor monitor(
      place_.executive, [this](const idl::Alarm& alarm) { reporter_.raise(alarm); },
      [&](const std::string& component, const std::string& what) {
        const ComponentInstance* const culprit = system_->component(component);
        const std::string hook = culprit != nullptr ? culprit->current_hook() : "";
        standstill(component, hook + (hook.empty() ? "" : " ") + what);
      },
      hang_limit_);
  place_.executive.run([this, &main] {
    runs_.store(true);
    main();
    runs_.store(false);
  });
}

void WatchedSystem::stop_motors() {
  if (place_.executive.tasks_overlap()) system_->stop_hardware(kMotorLimit);
}

Scene WatchedSystem::scene() {
  Scene scene;
  scene.start = start_;
  system_->draw(scene);
  reporter_.draw(scene);
  return scene;
}

// Raises an alarm. Alarms of the environment about a single component come on its strand.
void WatchedSystem::raise(idl::Alarm alarm) {
  const Activity* const activity = Activity::current();
  if (runs_.load() && activity != nullptr && alarm.source() == activity->who())
    if (const ComponentInstance* component = system_->component(alarm.source())) component->stamp(alarm);
  reporter_.raise(std::move(alarm));
}

}  // namespace orca::host
