// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "orca/sim/world_model.hpp"
#include "orca/xml/attributes.hpp"

namespace orca::sim::detail {

// Returns the reason why these corners do not bound an area; empty if they do.
[[nodiscard]] std::string polygon_fault(const std::vector<Vec2>& corners);

// Reads what belongs to the floor: sills, wet patches and chargers.
class FixtureReader {
 public:
  FixtureReader(WorldModel& world, xml::Reporter& reporter) : world_(world), reporter_(reporter) {}

  // @param name  that the element gives itself, or its kind.
  void sill(const xml::Attributes& element, const std::string& name);
  void wet(const xml::Attributes& element, const std::string& name);
  void leaf(const xml::Attributes& element, const std::string& name);
  void charger(const xml::Attributes& element, const std::string& name);
  // Gives the chargers their places. Reports those that the world does not have.
  // @pre  all places are read.
  void place_chargers();

 private:
  WorldModel& world_;
  xml::Reporter& reporter_;
  std::vector<xml::Position> charger_positions_;
};

}  // namespace orca::sim::detail
