// SPDX-License-Identifier: LGPL-3.0-or-later
#include "component_site.hpp"

#include <utility>

namespace orca::host {

ComponentSite::ComponentSite(RunContext& run, const ComponentSettings& settings, PortHome& home,
                             const LapTrigger& laps, Device* hardware)
    : run_(run), settings_(settings), home_(home), laps_(laps), hardware_(hardware) {}

void ComponentSite::forget_code() {
  declared_.ports.clear();
  declared_.params.clear();
}

void ComponentSite::reset() {
  declared_ = {};
  stays_active_ = false;
}

void ComponentSite::declare_port(PortDeclaration declaration) {
  declaration.contract.name = settings_.name_in_graph(declaration.contract.name);
  declared_.ports.push_back(std::move(declaration));
}

void ComponentSite::declare_param(ParamDeclaration declaration) {
  declared_.params.push_back(std::move(declaration));
}

void ComponentSite::set_default_trigger(const Trigger& trigger) {
  declared_.trigger = trigger;
  for (std::string& port : declared_.trigger.ports) port = settings_.name_in_graph(port);
}

RandomStream ComponentSite::random(std::string_view stream) const {
  return {run_.seed, settings_.name, stream};
}

void ComponentSite::write_log(log::Level level, std::string_view text) const {
  run_.reporter.log(level, settings_.name, text, home_.provenance.mission());
}

std::uint64_t ComponentSite::begin_mission() {
  const std::uint64_t mission = ++run_.missions;
  home_.provenance.begin_mission(mission);
  return mission;
}

std::vector<idl::Alarm> ComponentSite::take_alarms() {
  return run_.reporter.alarm_news().since(heard_alarms_);
}

std::vector<idl::Alarm> ComponentSite::kept_alarms() const { return run_.reporter.alarm_news().kept(); }

}  // namespace orca::host
