// SPDX-License-Identifier: LGPL-3.0-or-later
#include "extension_readers.hpp"

namespace orca::robots::detail {
namespace {

void check(const xml::Attributes& e, const LaserScanner& laser) {
  if (laser.min_range >= laser.max_range && laser.max_range > 0.0)
    e.error_at("min_range", codes::kContradiction, "min_range must be less than max_range");
  if (laser.divergence > 0.5 * std::numbers::pi)
    e.error_at("divergence", codes::kContradiction, "divergence must be at most 90 deg");
  if (laser.period > Duration{0}) check_period(e, laser.period);
  if (laser.sweep > laser.period && laser.period > Duration{0})
    e.error_at("sweep", codes::kContradiction, "the sweep of one scan cannot take longer than the period");
}

}  // namespace

void read_laser(const xml::Attributes& e, Characteristics& model) {
  LaserScanner laser;
  set(laser.name, e.name("name"));
  set(laser.link, e.text("link"));
  set(laser.count, e.integer("count"));
  set(laser.first_angle, e.number("first_angle"));
  set(laser.pitch, e.number("pitch"));
  set(laser.min_range, e.number_or("min_range", 0.0));
  set(laser.max_range, e.number("max_range"));
  set(laser.quantum, e.number_or("quantum", 0.0));
  set(laser.divergence, e.number_or("divergence", 0.0));
  set(laser.period, e.duration("period"));
  set(laser.sweep, e.duration_or("sweep", Duration{0}));
  check(e, laser);
  laser.label = read_label(e);
  laser.errors = read_range_errors(e, laser.max_range);
  if (name_is_free(e, laser.name, model)) model.lasers.push_back(std::move(laser));
}

}  // namespace orca::robots::detail
