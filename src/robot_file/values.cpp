// SPDX-License-Identifier: LGPL-3.0-or-later
#include "orca/robot_file/values.hpp"

#include <cmath>

#include "orca/base/text.hpp"
#include "orca/xml/number.hpp"
#include "orca/xml/quantity.hpp"

namespace orca::robot_file::values {
namespace {

using Kind = xml::ValueFault::Kind;

std::nullopt_t no_point(const xml::Attributes& element, const xml::Attribute& a, std::string_view text,
                        const std::string& why) {
  return element.refuse_value(a,
                              {Kind::form, in_quotes(text) + " is not a point" + why +
                                               "; write \"x y\" in metres, or with units \"1.5 m, 250 mm\""});
}

std::optional<Vec2> point_in(const xml::Attributes& element, const xml::Attribute& a, std::string_view text) {
  const bool comma = text.find(',') != std::string_view::npos;
  std::vector<std::string_view> pieces = comma ? xml::split(text, ",") : xml::words(text);
  std::erase(pieces, std::string_view{});
  if (pieces.size() != 2) return no_point(element, a, text, "");
  const Result<double> x = comma ? xml::parse_quantity(pieces[0], "m") : xml::parse_number(pieces[0]);
  const Result<double> y = comma ? xml::parse_quantity(pieces[1], "m") : xml::parse_number(pieces[1]);
  if (!x || !y) return no_point(element, a, text, " (" + (x ? y : x).error().message + ")");
  if (std::fmax(std::fabs(*x), std::fabs(*y)) > kFarthest)
    return element.refuse_value(
        a, {Kind::range, in_quotes(text) + " is farther than the 100 km that a world may reach"});
  return Vec2{*x, *y};
}

}  // namespace

std::optional<Vec2> read_point(const xml::Attributes& element, std::string_view name) {
  const xml::Attribute* a = element.readable(name);
  return a != nullptr ? point_in(element, *a, xml::trimmed(a->value)) : std::nullopt;
}

std::optional<std::vector<Vec2>> read_points(const xml::Attributes& element, std::string_view name) {
  const xml::Attribute* a = element.readable(name);
  if (a == nullptr) return std::nullopt;
  std::vector<Vec2> points;
  for (const std::string_view piece : xml::split(a->value, ";")) {
    const auto point = point_in(element, *a, piece);
    if (!point) return std::nullopt;
    points.push_back(*point);
  }
  return points;
}

}  // namespace orca::robot_file::values
