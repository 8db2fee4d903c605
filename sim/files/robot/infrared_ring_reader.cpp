// SPDX-License-Identifier: LGPL-3.0-or-later
#include "extension_readers.hpp"

namespace orca::sim::detail {
namespace {

constexpr std::size_t kMaxSensors = 256;

void check(const Attributes& e, const InfraredRing& ring) {
  if (ring.half_beam > 0.5 * std::numbers::pi)
    e.error_at("half_beam", 22, "half_beam must be at most 90 deg");
  if (ring.min_range >= ring.max_range && ring.max_range > 0.0)
    e.error_at("min_range", 22, "min_range must be less than max_range");
  if (ring.period > Duration{0}) check_period(e, ring.period);
}

}  // namespace

void read_infrared_ring(const Attributes& e, RobotModel& model) {
  e.allow({"name", "link", "count", "first_angle", "pitch", "half_beam", "min_range", "max_range", "radius",
           "period"},
          {});
  InfraredRing ring;
  set(ring.name, e.name("name"));
  set(ring.link, e.text("link"));
  set(ring.count, e.count("count", 1, kMaxSensors));
  set(ring.first_angle, e.quantity_or("first_angle", "rad", Sign::any, 0.0));
  set(ring.pitch, e.quantity("pitch", "rad", Sign::any));
  set(ring.half_beam, e.quantity("half_beam", "rad", Sign::positive));
  set(ring.min_range, e.quantity_or("min_range", "m", Sign::not_negative, 0.0));
  set(ring.max_range, e.quantity("max_range", "m", Sign::positive));
  set(ring.radius, e.quantity_or("radius", "m", Sign::not_negative, model.radius));
  set(ring.period, e.duration("period", Sign::positive));
  check(e, ring);
  if (name_is_free(e, ring.name, model)) model.infrareds.push_back(std::move(ring));
}

}  // namespace orca::sim::detail
