// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "orca/geometry/vec2.hpp"

namespace orca::batch {

/// Places that a line joins: [m] in the world, or [pixels] in a drawing, where y points down.
using Places = std::vector<Vec2>;

/// The parts of a drawing [pixels]. Colours are as in SVG, "#444" or "#0072b2". Plain values.
struct Stroke {
  Vec2 from, to;
  std::string colour;
};
struct Words {
  Vec2 at;  ///< On the base line.
  std::string text;
  std::string anchor = "start";  ///< The part of the text that is at `at`: "start", "middle" or "end".
  std::string colour = "#222";
};
struct Polyline {
  Places places;
  std::string colour;
  double width;
};
struct Walls {
  std::vector<Places> lines;
};
struct Circle {
  Vec2 centre;
  std::string colour;
};
struct Bar {
  Vec2 corner;  ///< Upper left.
  Vec2 size;
  std::string colour;
};
using Part = std::variant<Stroke, Words, Polyline, Walls, Circle, Bar>;

/// A drawing of some size [pixels], as its parts, in the order in which they are drawn. A plain value.
struct Drawing {
  Vec2 size;
  std::vector<Part> parts{};

  template <class Kind>
  void add(Kind part) {
    parts.emplace_back(std::move(part));
  }
};

/// Returns the drawing as an SVG element, with a description if there is one.
[[nodiscard]] std::string to_svg(const Drawing& drawing, const std::string& description = "");

/// Returns the drawing as a PDF file of one page, a point for each pixel; empty if Cairo cannot draw it. It holds no date: equal
/// drawings are equal files, if made with the same version of Cairo and the same fonts.
/// @thread  any.
[[nodiscard]] std::string to_pdf(const Drawing& drawing, const std::string& description);

}  // namespace orca::batch
