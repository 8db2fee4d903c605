// SPDX-License-Identifier: LGPL-3.0-or-later
#include "live_view.hpp"

#include <algorithm>

namespace orca::host {

RunGlance LiveView::look() const {
  RunGlance glance;
  glance.time = executive_.now() - start_;
  glance.is_virtual = executive_.is_virtual();
  glance.working = static_cast<std::size_t>(std::ranges::count_if(
      system_.components(), [](const auto& c) { return c->state() == ComponentState::work; }));
  glance.unwell = system_.unwell();
  glance.goals = sightings_.goals();
  glance.last_alarm = reporter_.last_alarm();
  return glance;
}

}  // namespace orca::host
