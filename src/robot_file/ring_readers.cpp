// SPDX-License-Identifier: LGPL-3.0-or-later
#include <algorithm>
#include <cmath>
#include <numbers>

#include "orca/base/text.hpp"
#include "orca/xml/quantity.hpp"
#include "part_readers.hpp"

namespace orca::robot_file {
namespace {

constexpr double kWidestScan = 4.0 * std::numbers::pi + 1e-6;  // [rad] Receivers take no wider one.
constexpr double kLongestRange = 1000.0;                       // [m] likewise

void check(const xml::Attributes& e, const LaserScanner& laser) {
  check_range(e, laser.min_range, laser.max_range, laser.quantum);
  if (std::fabs(laser.pitch) * static_cast<double>(laser.count) > kWidestScan)
    e.error_at("pitch", codes::kContradiction,
               "all beams together must span at most two turns; an angle without a unit is in radians");
  if (laser.divergence > 0.5 * std::numbers::pi)
    e.error_at("divergence", codes::kContradiction, "divergence must be at most 90 deg");
  if (laser.period > Duration{0}) check_period(e, laser.period);
  if (laser.sweep > laser.period && laser.period > Duration{0})
    e.error_at("sweep", codes::kContradiction, "the sweep of one scan cannot take longer than the period");
}

void check(const xml::Attributes& e, const InfraredRing& ring) {
  if (ring.half_beam > 0.5 * std::numbers::pi)
    e.error_at("half_beam", codes::kContradiction, "half_beam must be at most 90 deg");
  check_range(e, ring.min_range, ring.max_range);
  if (ring.period > Duration{0}) check_period(e, ring.period);
}

constexpr double kRounding = 1e-6;  // [rad] "22.5 deg" times 16 may miss a full turn by this.

void read_directions(const xml::Attributes& e, BumperRing& ring) {
  set(ring.first_angle, e.number_or("first_angle", 0.0));
  if (!e.has("angles")) return;
  if (e.has("first_angle"))
    e.error_at("first_angle", codes::kContradiction,
               "the directions are given by angles already; write one of the two");
  if (ring.count > 0) set(ring.angles, e.numbers("angles", ring.count));
}

// Reads sectors with ';' between them: "50 deg, 65 deg".
std::vector<LaserScanner::Sector> read_sectors(const xml::Attributes& e, std::string_view name) {
  std::vector<LaserScanner::Sector> sectors;
  const xml::Attribute* const a = e.readable(name);
  if (a == nullptr) return sectors;
  for (const std::string_view piece : xml::split(a->value, ";")) {
    const std::vector<std::string_view> ends = xml::split(piece, ",");
    const auto angle = [&](std::size_t i) { return xml::parse_quantity(ends[i], "rad"); };
    if (ends.size() == 2 && angle(0) && angle(1) && *angle(0) < *angle(1)) {
      sectors.push_back({angle(0).value(), angle(1).value()});
    } else {
      e.error_at(
          name, codes::kBadValue,
          in_quotes(std::string(piece)) +
              " is not a sector; write two angles, the smaller one first, as in \"50 deg, 65 deg\", and ';' "
              "between sectors");
    }
  }
  return sectors;
}

}  // namespace

void check_range(const xml::Attributes& e, double min_range, double max_range, double quantum) {
  if (min_range >= max_range && max_range > 0.0)
    e.error_at("min_range", codes::kContradiction, "min_range must be less than max_range");
  if (max_range > kLongestRange)
    e.error_at("max_range", codes::kContradiction, "max_range must be at most 1000 m");
  if (quantum >= max_range && max_range > 0.0)
    e.error_at("quantum", codes::kContradiction,
               "quantum must be less than max_range; a length without a unit is in metres");
}

bool LaserScanner::ignores(double angle) const {
  return std::ranges::any_of(ignore, [&](const Sector& sector) {
    const double half = 0.5 * (sector.to - sector.from);
    return std::fabs(std::remainder(angle - sector.from - half, 2.0 * std::numbers::pi)) <= half + kRounding;
  });
}

void read_laser(const xml::Attributes& e, Devices& model) {
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
  if (e.has("sees"))
    for (const std::string_view link : xml::words(e.attribute("sees")->value)) laser.sees.emplace_back(link);
  laser.ignore = read_sectors(e, "ignore");
  check(e, laser);
  laser.label = read_label(e);
  laser.errors = read_range_errors(e, laser.max_range);
  if (name_is_free(e, laser.name, model)) model.lasers.push_back(std::move(laser));
}

void read_infrared_ring(const xml::Attributes& e, Devices& model) {
  InfraredRing ring;
  set(ring.name, e.name("name"));
  set(ring.link, e.text("link"));
  set(ring.count, e.integer("count"));
  set(ring.first_angle, e.number_or("first_angle", 0.0));
  set(ring.pitch, e.number("pitch"));
  set(ring.half_beam, e.number("half_beam"));
  set(ring.min_range, e.number_or("min_range", 0.0));
  set(ring.max_range, e.number("max_range"));
  set(ring.radius, e.number_or("radius", model.radius));
  set(ring.period, e.duration("period"));
  check(e, ring);
  ring.label = read_label(e);
  ring.errors = read_range_errors(e, ring.max_range);
  if (name_is_free(e, ring.name, model)) model.infrareds.push_back(std::move(ring));
}

void read_bumper_ring(const xml::Attributes& e, Devices& model) {
  BumperRing ring;
  set(ring.name, e.name("name"));
  set(ring.count, e.integer("count"));
  read_directions(e, ring);
  set(ring.pitch, e.number("pitch"));
  set(ring.radius, e.number_or("radius", model.bumper_radius));
  set(ring.period, e.duration("period"));
  if (std::fabs(ring.pitch) * static_cast<double>(ring.count) > 2.0 * std::numbers::pi + kRounding)
    e.error_at("pitch", codes::kContradiction, "the segments are wider than a full turn together");
  if (ring.period > Duration{0}) check_period(e, ring.period);
  ring.label = read_label(e);
  if (name_is_free(e, ring.name, model)) model.bumpers.push_back(std::move(ring));
}

}  // namespace orca::robot_file
