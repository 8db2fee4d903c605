// SPDX-License-Identifier: LGPL-3.0-or-later
#include <algorithm>
#include <numeric>

#include "extension_readers.hpp"

namespace orca::sim::detail {
namespace {

constexpr std::size_t kMaxTransducers = 256;

void read_order(const Attributes& e, SonarRing& ring) {
  ring.order.resize(ring.count);
  std::iota(ring.order.begin(), ring.order.end(), std::size_t{0});
  if (ring.count == 0 || !e.has("order")) return;
  const auto given = e.numbers("order", ring.count);
  if (!given) return;
  std::vector<double> sorted = *given;
  std::ranges::sort(sorted);
  for (std::size_t k = 0; k < ring.count; ++k)
    if (sorted[k] != static_cast<double>(k))
      return e.error_at(
          "order", 22,
          "the firing order must name each transducer from 0 to " + std::to_string(ring.count - 1) + " once");
  std::ranges::transform(*given, ring.order.begin(), [](double k) { return static_cast<std::size_t>(k); });
}

// Evenly on a circle, or as listed.
void read_directions(const Attributes& e, SonarRing& ring) {
  if (!e.has("angles")) {
    set(ring.first_angle, e.quantity_or("first_angle", "rad", Sign::any, 0.0));
    set(ring.pitch, e.quantity("pitch", "rad", Sign::any));
    if (e.has("positions"))
      e.error_at("positions", 22, "positions need angles: where each transducer looks is not said");
    return;
  }
  for (const char* even : {"first_angle", "pitch"})
    if (e.has(even)) e.error_at(even, 22, "the directions are given by angles already; write one of the two");
  if (ring.count > 0) set(ring.angles, e.quantities("angles", "rad", ring.count));
}

void read_positions(const Attributes& e, SonarRing& ring, double robot_radius) {
  set(ring.radius, e.quantity_or("radius", "m", Sign::not_negative, robot_radius));
  if (ring.count == 0) return;  // Told already.
  if (e.has("heights")) set(ring.heights, e.quantities("heights", "m", ring.count));
  if (!e.has("positions") || !e.has("angles")) return;
  set(ring.positions, e.points("positions"));
  if (!ring.positions.empty() && ring.positions.size() != ring.count)
    e.error_at("positions", 22,
               "there are " + std::to_string(ring.positions.size()) + " positions for " +
                   std::to_string(ring.count) + " transducers");
}

void check_ring(const Attributes& e, const SonarRing& ring) {
  if (ring.half_lobe > 0.5 * std::numbers::pi)
    e.error_at("half_lobe", 22, "half_lobe must be at most 90 deg");
  if (ring.min_range >= ring.max_range && ring.max_range > 0.0)
    e.error_at("min_range", 22, "min_range must be less than max_range");
  if (ring.period > Duration{0}) check_period(e, ring.period);
}

}  // namespace

void read_sonar_ring(const Attributes& e, RobotModel& model) {
  e.allow({"name", "count", "first_angle", "pitch", "angles", "positions", "heights", "half_lobe",
           "min_range", "max_range", "quantum", "radius", "period", "link", "order", "parallel"},
          {});
  SonarRing ring;
  set(ring.name, e.name("name"));
  set(ring.count, e.count("count", 1, kMaxTransducers));
  read_directions(e, ring);
  read_positions(e, ring, model.radius);
  set(ring.half_lobe, e.quantity("half_lobe", "rad", Sign::positive));
  set(ring.min_range, e.quantity("min_range", "m", Sign::not_negative));
  set(ring.max_range, e.quantity("max_range", "m", Sign::positive));
  set(ring.quantum, e.quantity_or("quantum", "m", Sign::not_negative, 0.0));
  set(ring.period, e.duration("period", Sign::positive));
  set(ring.link, e.text("link"));
  read_order(e, ring);
  if (e.has("parallel") && ring.count > 0) set(ring.parallel, e.count("parallel", 1, ring.count));
  check_ring(e, ring);
  if (name_is_free(e, ring.name, model)) model.sonars.push_back(std::move(ring));
}

}  // namespace orca::sim::detail
