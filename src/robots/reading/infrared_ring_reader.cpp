// SPDX-License-Identifier: LGPL-3.0-or-later
#include "extension_readers.hpp"

namespace orca::robots::detail {
namespace {

void check(const xml::Attributes& e, const InfraredRing& ring) {
  if (ring.half_beam > 0.5 * std::numbers::pi)
    e.error_at("half_beam", codes::kContradiction, "half_beam must be at most 90 deg");
  if (ring.min_range >= ring.max_range && ring.max_range > 0.0)
    e.error_at("min_range", codes::kContradiction, "min_range must be less than max_range");
  if (ring.period > Duration{0}) check_period(e, ring.period);
}

}  // namespace

void read_infrared_ring(const xml::Attributes& e, Characteristics& model) {
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

}  // namespace orca::robots::detail
