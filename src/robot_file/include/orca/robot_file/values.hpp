// SPDX-License-Identifier: LGPL-3.0-or-later
// The values that attributes of world and robot files have in common.
#pragma once

#include <optional>
#include <string_view>
#include <vector>

#include "orca/geometry/vec2.hpp"
#include "orca/xml/attributes.hpp"

namespace orca::robot_file::values {

// [m] Far enough for any robot, and near enough for coordinates that are exact to a fraction of a nanometre.
inline constexpr double kFarthest = 1e5;

using xml::ValueRule;

constexpr ValueRule any(std::string_view unit) { return {.form = ValueRule::Form::number, .unit = unit}; }
constexpr ValueRule not_negative(std::string_view unit, double max = ValueRule::kUnlimited) {
  return {.form = ValueRule::Form::number, .unit = unit, .min = 0.0, .max = max};
}
constexpr ValueRule positive(std::string_view unit, double max = ValueRule::kUnlimited) {
  return {.form = ValueRule::Form::number, .unit = unit, .min = 0.0, .max = max, .above_min = true};
}
constexpr ValueRule whole(double min, double max) {
  return {.form = ValueRule::Form::integer, .min = min, .max = max};
}
constexpr ValueRule one_of(std::span<const std::string_view> choices) { return {.choices = choices}; }

inline constexpr double kHundredYears = 100.0 * 365.25 * 86400.0;  // [s]
inline constexpr ValueRule kText{};
inline constexpr ValueRule kName{.form = ValueRule::Form::name};
inline constexpr ValueRule kCoordinate{
    .form = ValueRule::Form::number, .unit = "m", .min = -kFarthest, .max = kFarthest};
inline constexpr ValueRule kLength = positive("m", kFarthest);
inline constexpr ValueRule kLengthOrZero = not_negative("m", kFarthest);
inline constexpr double kWholeTurn = 6.2832;  // [rad] A larger angle is one of degrees.
inline constexpr ValueRule kAngle{
    .form = ValueRule::Form::number, .unit = "rad", .min = -kWholeTurn, .max = kWholeTurn};
inline constexpr ValueRule kTime = not_negative("s", kHundredYears);
inline constexpr ValueRule kPeriod = positive("s", kHundredYears);

constexpr xml::AttributeRule required(std::string_view name, const ValueRule& value) {
  return {.name = name, .required = true, .value = value};
}
constexpr xml::AttributeRule optional(std::string_view name, const ValueRule& value) {
  return {.name = name, .value = value};
}

// Assigns a value if there is one. If there is none, the error is reported already.
template <class To, class From>
void set(To& to, const std::optional<From>& from) {
  if (from) to = static_cast<To>(*from);
}

// Reads a point [m]: "x y", or with units "1.5 m, 250 mm".
[[nodiscard]] std::optional<Vec2> read_point(const xml::Attributes& element, std::string_view name);
// Reads points [m] with ';' between them.
[[nodiscard]] std::optional<std::vector<Vec2>> read_points(const xml::Attributes& element,
                                                           std::string_view name);

}  // namespace orca::robot_file::values
