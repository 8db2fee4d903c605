// SPDX-License-Identifier: LGPL-3.0-or-later
#include "extension_readers.hpp"

namespace orca::sim::detail {
namespace {

constexpr std::size_t kMaxSegments = 256;
constexpr double kRounding = 1e-6;  // [rad] "22.5 deg" times 16 may miss a full turn by this.

}  // namespace

void read_bumper_ring(const Attributes& e, RobotModel& model) {
  e.allow({"name", "count", "first_angle", "pitch", "radius", "period"}, {});
  BumperRing ring;
  set(ring.name, e.name("name"));
  set(ring.count, e.count("count", 1, kMaxSegments));
  set(ring.first_angle, e.quantity_or("first_angle", "rad", Sign::any, 0.0));
  set(ring.pitch, e.quantity("pitch", "rad", Sign::any));
  set(ring.radius, e.quantity_or("radius", "m", Sign::not_negative, model.bumper_radius));
  set(ring.period, e.duration("period", Sign::positive));
  if (std::fabs(ring.pitch) * static_cast<double>(ring.count) > 2.0 * std::numbers::pi + kRounding)
    e.error_at("pitch", 22, "the segments are wider than a full turn together");
  if (ring.period > Duration{0}) check_period(e, ring.period);
  if (name_is_free(e, ring.name, model)) model.bumpers.push_back(std::move(ring));
}

}  // namespace orca::sim::detail
