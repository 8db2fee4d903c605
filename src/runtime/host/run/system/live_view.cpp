// SPDX-License-Identifier: LGPL-3.0-or-later
#include "live_view.hpp"

namespace orca::host {

RunGlance LiveView::look() const {
  RunGlance glance;
  glance.time = executive_.now() - start_;
  glance.is_virtual = executive_.is_virtual();
  glance.working = system_.components().working();
  glance.unwell = system_.unwell();
  glance.goals = sightings_.goals();
  glance.last_alarm = reporter_.last_alarm();
  return glance;
}

}  // namespace orca::host
