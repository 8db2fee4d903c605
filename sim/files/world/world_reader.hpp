// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "event_reader.hpp"
#include "fixture_reader.hpp"
#include "model/walls.hpp"
#include "orca/sim/world_model.hpp"
#include "orca/xml/attributes.hpp"

namespace orca::sim::detail {

// The reader of a <world>: turns its elements into a WorldModel and reports all errors.
class WorldReader {
 public:
  // @param seed  seed of all generated things, instead of the file's own.
  WorldReader(const std::string& file_name, std::optional<std::uint64_t> seed, xml::Diagnostics& diagnostics)
      : file_name_(file_name), seed_(seed), reporter_(diagnostics) {}

  WorldModel read(const xml::Element& root);

 private:
  using Attributes = xml::Attributes;
  // An element inside <world>, and the function that reads it.
  struct Reader {
    const xml::ElementRule* rule;
    void (WorldReader::*read)(const Attributes&);
  };
  static const std::array<Reader, 11> kReaders;

  void header(const Attributes& world);
  void read_base(const Attributes& world);
  void read_elements(const Attributes& world);
  void wall(const Attributes& element);
  void room(const Attributes& element);
  void box(const Attributes& element);
  void cylinder(const Attributes& element);
  void polygon(const Attributes& element);
  void bitmap(const Attributes& element);
  void mesh(const Attributes& element);
  void place(const Attributes& element);
  void generate(const Attributes& element);
  void walker(const Attributes& element);
  void item(const Attributes& element);

  void add_wall(const Attributes& element, WallPlan plan);
  void add(const Attributes& element, Shape shape, double height);
  void add_visitor(const Attributes& element, Shape shape, const Pose2& X_WO, double height);
  void add_place(const Attributes& element, Place place);
  [[nodiscard]] Attributes attributes_of(const xml::Element& element, const xml::ElementRule& rule);
  // Returns the name that the element gives itself, its kind if it gives none. Reports a name that is taken.
  std::string own_name(const Attributes& element);
  void claim(const Attributes& element, const std::string& kind, const std::string& name);
  void check_places();
  void check_walkers();
  void check_items();
  void check_seed();

  std::string file_name_;
  std::optional<std::uint64_t> seed_;
  xml::Reporter reporter_;
  WorldModel world_;
  EventReader events_{reporter_};
  FixtureReader fixtures_{world_, reporter_};
  std::map<std::string, xml::Position> taken_;  // Places of the elements by kind and name.
  std::vector<xml::Position> place_positions_;
  std::vector<xml::Position> walker_positions_;
  std::vector<xml::Position> item_positions_;
  std::size_t faces_ = 0;                   // Number of faces of all meshes.
  std::optional<xml::Position> generated_;  // Place of the <generate> element.
};

}  // namespace orca::sim::detail
