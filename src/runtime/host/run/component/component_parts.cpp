// SPDX-License-Identifier: LGPL-3.0-or-later
#include "component_parts.hpp"

#include <utility>

namespace orca::host {

ComponentParts::ComponentParts(RunContext& run_of_all, ComponentSettings settings_of_this, Device* hardware)
    : run(run_of_all),
      settings(std::move(settings_of_this)),
      strand(run.executive, {settings.name, settings.priority}),
      home{strand, settings.name, &run.reporter, {}},
      ports(home),
      site(run, settings, home, laps, hardware),
      hooks(settings.name),
      injector(settings.failure, site, strand, laps),
      params(settings.params),
      orders(strand) {}

void ComponentParts::report_failure(Hook hook, const std::string& text, const char* port) {
  site.write_log(log::Level::error, text);
  idl::Alarm alarm = make_alarm(AlarmKind::failed, settings.name, hook_text(hook, port), text);
  home.provenance.stamp(alarm);
  run.reporter.note(std::move(alarm));
}

}  // namespace orca::host
