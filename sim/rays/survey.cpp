// SPDX-License-Identifier: LGPL-3.0-or-later
// The search for everything that can be seen in a cone, nearest first.
#include <algorithm>
#include <array>

#include "bodies.hpp"
#include "grid.hpp"
#include "panorama.hpp"
#include "strips.hpp"

namespace orca::sim::detail {
namespace {

// The elements of a grid that were looked at last. Most elements lie in few cells that follow each other, and
// looking at one twice costs time only.
class LastLooks {
 public:
  LastLooks() { elements_.fill(0xffffffffU); }
  // Returns true if the element is not among them, and adds it.
  bool add(std::uint32_t element) {
    std::uint32_t& place = elements_[element % elements_.size()];
    if (place == element) return false;
    place = element;
    return true;
  }

 private:
  std::array<std::uint32_t, 64> elements_;
};

}  // namespace

void Grid::show(const Cone& cone, std::uint64_t first, std::uint64_t step, Panorama& view) const {
  const int parts = std::max(1, static_cast<int>(std::ceil(cone.half_angle / Strips::kWide)));
  const double half = cone.half_angle / parts;
  for (int i = 0; i < parts; ++i) {
    const Vec2 axis = parts == 1 ? cone.axis : rotated(cone.axis, (2 * i + 1 - parts) * half);
    show_part({cone.tip, axis, half, cone.slack, cone.reach}, first, step, view);
  }
}

void Grid::show_part(const Cone& cone, std::uint64_t first, std::uint64_t step, Panorama& view) const {
  const auto show = [&](std::uint32_t element) {
    const std::uint64_t number = first + step * element;
    elements_.with(
        element,
        [&](const Elements::Edge& e) { view.add(e.segment, number, e.heights.bottom, e.heights.top); },
        [&](const Elements::Round& r) { view.add(r.circle, number, r.heights.bottom, r.heights.top); });
  };
  regions_.survey(cone, [&](const CellLists& lists) {
    LastLooks looked_at;
    for (Strips strips(lists.cells(), cone); strips.begin() < std::min(cone.reach, view.far());)
      strips.next([&](std::size_t cell) {
        for (const std::uint32_t element : lists.at(cell))
          if (looked_at.add(element)) show(element);
      });
  });
}

void Bodies::show(const Cone& cone, std::size_t without, std::uint64_t first, Panorama& view) const {
  std::vector<std::uint32_t>& near = view.numbers();
  near.clear();
  discs_.find_near(cone, near);
  for (const std::uint32_t number : near) {
    const Moving& moving = bodies_[number];
    if (number == without || !moving.present) continue;
    for (const Piece& piece : moving.pieces) {
      const Body& solid = piece.solid;
      std::uint64_t element = first + number * kMostEdges + piece.first;
      if (const auto* circle = std::get_if<Circle>(&solid.shape))
        view.add(*circle, element, solid.bottom, solid.top);
      for (const Segment& edge : piece.edges) view.add(edge, element++, solid.bottom, solid.top);
    }
  }
}

}  // namespace orca::sim::detail
