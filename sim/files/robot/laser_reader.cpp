// SPDX-License-Identifier: LGPL-3.0-or-later
#include "extension_readers.hpp"

namespace orca::sim::detail {
namespace {

constexpr std::size_t kMaxReadings = 10'000;

void check(const Attributes& e, const LaserScanner& laser) {
  if (laser.min_range >= laser.max_range && laser.max_range > 0.0)
    e.error_at("min_range", 22, "min_range must be less than max_range");
  if (laser.divergence > 0.5 * std::numbers::pi)
    e.error_at("divergence", 22, "divergence must be at most 90 deg");
  if (laser.period > Duration{0}) check_period(e, laser.period);
  if (laser.sweep > laser.period && laser.period > Duration{0})
    e.error_at("sweep", 22, "the sweep of one scan cannot take longer than the period");
}

}  // namespace

void read_laser(const Attributes& e, RobotModel& model) {
  e.allow({"name", "link", "count", "first_angle", "pitch", "min_range", "max_range", "quantum", "divergence",
           "period", "sweep"},
          {});
  LaserScanner laser;
  set(laser.name, e.name("name"));
  set(laser.link, e.text("link"));
  set(laser.count, e.count("count", 1, kMaxReadings));
  set(laser.first_angle, e.quantity("first_angle", "rad", Sign::any));
  set(laser.pitch, e.quantity("pitch", "rad", Sign::any));
  set(laser.min_range, e.quantity_or("min_range", "m", Sign::not_negative, 0.0));
  set(laser.max_range, e.quantity("max_range", "m", Sign::positive));
  set(laser.quantum, e.quantity_or("quantum", "m", Sign::not_negative, 0.0));
  set(laser.divergence, e.quantity_or("divergence", "rad", Sign::not_negative, 0.0));
  set(laser.period, e.duration("period", Sign::positive));
  set(laser.sweep, e.duration_or("sweep", Duration{0}));
  check(e, laser);
  if (name_is_free(e, laser.name, model)) model.lasers.push_back(std::move(laser));
}

}  // namespace orca::sim::detail
