// SPDX-License-Identifier: LGPL-3.0-or-later
#include "extension_readers.hpp"

namespace orca::robots::detail {
namespace {

constexpr double kRounding = 1e-6;  // [rad] "22.5 deg" times 16 may miss a full turn by this.

void read_directions(const xml::Attributes& e, BumperRing& ring) {
  set(ring.first_angle, e.number_or("first_angle", 0.0));
  if (!e.has("angles")) return;
  if (e.has("first_angle"))
    e.error_at("first_angle", codes::kContradiction,
               "the directions are given by angles already; write one of the two");
  if (ring.count > 0) set(ring.angles, e.numbers("angles", ring.count));
}

}  // namespace

void read_bumper_ring(const xml::Attributes& e, Characteristics& model) {
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

}  // namespace orca::robots::detail
