// SPDX-License-Identifier: LGPL-3.0-or-later
#include "component_parts.hpp"

#include <utility>

namespace orca::host {

ComponentParts::ComponentParts(RunContext& run_of_all, ComponentSettings settings_of_this, Device* device)
    : run(run_of_all),
      settings(std::move(settings_of_this)),
      hardware(device),
      strand(run.executive, {settings.name, settings.priority}),
      home{strand, settings.name, &run.reporter, {}},
      ports(home),
      lap_shares(run.seed, settings.name, "takes"),
      recent_laps(run.executive.is_virtual() || !run.executive.tasks_overlap()
                      ? nullptr
                      : std::make_unique<RecentTimes>()),
      hooks(settings.name),
      injector(run, settings, strand, laps),
      params(settings.params),
      orders(strand) {
  if (settings.cores != nullptr) home.computing.share(*settings.cores);
  if (run.measures_laps) meter = std::make_unique<LapMeter>();
}

void ComponentParts::write_log(log::Level level, std::string_view text) const {
  run.reporter.log(level, settings.name, text, home.provenance.mission());
}

void ComponentParts::report_failure(Hook hook, const std::string& text, const char* port) {
  write_log(log::Level::error, text);
  idl::Alarm alarm = make_alarm(idl::FAILED, settings.name, hook_text(hook, port), text);
  home.provenance.stamp(alarm);
  run.reporter.note(std::move(alarm));
}

// Whoever sends twenty commands a second would fill the log while a device is held.
void ComponentParts::report_refusal(const std::string& text) {
  constexpr Duration kInterval = std::chrono::seconds(10);
  if (text != last_refusal) {
    last_refusal = text;
    refusal_lines.emplace(kInterval);
  }
  if (const auto left_out = refusal_lines->admit(text, now()))
    write_log(log::Level::warning, text + mention_left_out(*left_out));
}

void ComponentParts::raise_alarm(const std::string& kind, idl::AlarmSeverity severity,
                                 const std::string& text) {
  const auto [own, is_new] = own_alarms.try_emplace(kind);
  if (!is_new && own->second.active()) return;
  own->second = make_alarm(kind, severity, settings.name, text);
  idl::Alarm alarm = own->second;
  home.provenance.stamp(alarm);
  run.reporter.raise(std::move(alarm));
}

void ComponentParts::clear_alarm(const std::string& kind, const std::string& text) {
  const auto own = own_alarms.find(kind);
  if (own == own_alarms.end() || !own->second.active()) return;
  own->second.active(false);
  own->second.text(text);
  write_log(log::Level::info, "alarm " + kind + " is over: " + text);
  run.reporter.note(own->second);
}

}  // namespace orca::host
