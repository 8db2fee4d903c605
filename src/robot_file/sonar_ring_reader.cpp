// SPDX-License-Identifier: LGPL-3.0-or-later
#include <algorithm>
#include <numeric>

#include "part_readers.hpp"

namespace orca::robot_file {
namespace {

void read_order(const xml::Attributes& e, SonarRing& ring) {
  ring.order.resize(ring.count);
  std::iota(ring.order.begin(), ring.order.end(), std::size_t{0});
  if (ring.count == 0 || !e.has("order")) return;
  const auto given = e.bare_numbers("order", ring.count);
  if (!given) return;
  std::vector<double> sorted = *given;
  std::ranges::sort(sorted);
  for (std::size_t k = 0; k < ring.count; ++k)
    if (sorted[k] != static_cast<double>(k))
      return e.error_at(
          "order", codes::kContradiction,
          "the firing order must name each transducer from 0 to " + std::to_string(ring.count - 1) + " once");
  std::ranges::transform(*given, ring.order.begin(), [](double k) { return static_cast<std::size_t>(k); });
}

// Reads the directions of the transducers: evenly on a circle, or as listed.
void read_directions(const xml::Attributes& e, SonarRing& ring) {
  if (!e.has("angles")) {
    set(ring.first_angle, e.number_or("first_angle", 0.0));
    if (e.require("pitch")) set(ring.pitch, e.number("pitch"));
    if (e.has("positions"))
      e.error_at("positions", codes::kContradiction,
                 "positions need angles: where each transducer looks is not said");
    return;
  }
  for (const char* even : {"first_angle", "pitch"})
    if (e.has(even))
      e.error_at(even, codes::kContradiction,
                 "the directions are given by angles already; write one of the two");
  if (ring.count > 0) set(ring.angles, e.numbers("angles", ring.count));
}

void read_positions(const xml::Attributes& e, SonarRing& ring, double robot_radius) {
  set(ring.radius, e.number_or("radius", robot_radius));
  if (ring.count == 0) return;  // Reported already.
  if (e.has("heights")) set(ring.heights, e.numbers("heights", ring.count));
  if (!e.has("positions") || !e.has("angles")) return;
  set(ring.positions, read_points(e, "positions"));
  if (!ring.positions.empty() && ring.positions.size() != ring.count)
    e.error_at("positions", codes::kContradiction,
               "there are " + std::to_string(ring.positions.size()) + " positions for " +
                   std::to_string(ring.count) + " transducers");
}

void check_ring(const xml::Attributes& e, const SonarRing& ring) {
  if (ring.half_lobe > 0.5 * std::numbers::pi)
    e.error_at("half_lobe", codes::kContradiction, "half_lobe must be at most 90 deg");
  check_range(e, ring.min_range, ring.max_range, ring.quantum);
  if (ring.period > Duration{0}) check_period(e, ring.period);
}

}  // namespace

void read_sonar_ring(const xml::Attributes& e, Devices& model) {
  SonarRing ring;
  set(ring.name, e.name("name"));
  set(ring.count, e.integer("count"));
  read_directions(e, ring);
  read_positions(e, ring, model.radius);
  set(ring.half_lobe, e.number("half_lobe"));
  set(ring.min_range, e.number("min_range"));
  set(ring.max_range, e.number("max_range"));
  set(ring.quantum, e.number_or("quantum", 0.0));
  set(ring.offset, e.number_or("offset", 0.0));
  set(ring.period, e.duration("period"));
  set(ring.link, e.text("link"));
  read_order(e, ring);
  if (e.has("parallel") && ring.count > 0)
    set(ring.parallel, e.integer("parallel", whole(1, static_cast<double>(ring.count))));
  check_ring(e, ring);
  ring.label = read_label(e);
  ring.errors = read_range_errors(e, ring.max_range);
  if (name_is_free(e, ring.name, model)) model.sonars.push_back(std::move(ring));
}

}  // namespace orca::robot_file
