// SPDX-License-Identifier: LGPL-3.0-or-later
#include "attributes.hpp"

#include <algorithm>

#include "orca/xml/names.hpp"
#include "orca/xml/number.hpp"
#include "orca/xml/quantity.hpp"

namespace orca::sim::detail {
namespace {

bool among(const std::vector<std::string>& names, std::string_view name) {
  return std::ranges::find(names, name) != names.end();
}

std::string help(std::string_view word, const std::vector<std::string>& allowed, const char* where) {
  return xml::did_you_mean(xml::nearest_name(word, allowed)) + "; " + where + ": " + xml::listed(allowed);
}

// [m] Far enough for any robot, near enough for coordinates exact to a nanometre's fraction.
constexpr double kFarthest = 1e5;

std::string too_far(std::string_view text) {
  return "\"" + std::string(text) + "\" is farther than the 100 km that a world may reach";
}

std::vector<std::string_view> words(std::string_view text) {
  auto pieces = split(text, " \t\n\r");
  std::erase(pieces, std::string_view{});
  return pieces;
}

bool is_name(std::string_view text) {
  const auto letter = [](char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z'); };
  const auto inner = [&](char c) { return letter(c) || (c >= '0' && c <= '9') || c == '_'; };
  return !text.empty() && text.size() <= 200 && letter(text.front()) && std::ranges::all_of(text, inner);
}

}  // namespace

std::vector<std::string_view> split(std::string_view text, std::string_view separators) {
  std::vector<std::string_view> pieces;
  for (std::size_t start = 0;;) {
    const std::size_t end = text.find_first_of(separators, start);
    pieces.push_back(xml::trimmed(text.substr(start, end == std::string_view::npos ? end : end - start)));
    if (end == std::string_view::npos) return pieces;
    start = end + 1;
  }
}

std::string Attributes::code(int number) const {
  const std::string digits = std::to_string(number);
  return letter_ + std::string(3 - digits.size(), '0') + digits;
}

void Attributes::error(int number, const std::string& message) const {
  diagnostics_.error(code(number), element_.position(), message);
}

void Attributes::error_at(std::string_view attribute, int number, const std::string& message) const {
  const xml::Attribute* a = element_.attribute(attribute);
  diagnostics_.error(code(number), a != nullptr ? a->value_position : element_.position(), message);
}

void Attributes::wrong(const xml::Attribute& attribute, const std::string& message) const {
  diagnostics_.error(code(5), attribute.value_position, attribute.name + ": " + message);
}

void Attributes::allow(const std::vector<std::string>& attributes,
                       const std::vector<std::string>& children) const {
  for (const xml::Attribute& a : element_.attributes())
    if (!among(attributes, a.name))
      diagnostics_.error(code(3), a.position,
                         "<" + element_.name() + "> has no attribute \"" + a.name + "\"" +
                             help(a.name, attributes, "it has"));
  for (const xml::Element& e : element_.children())
    if (!among(children, e.name()))
      diagnostics_.error(code(2), e.position(),
                         "<" + e.name() + "> is not known inside <" + element_.name() + ">" +
                             help(e.name(), children, "known are"));
  if (!xml::trimmed(element_.text()).empty())
    diagnostics_.error(
        code(6), element_.text_position(),
        "text inside <" + element_.name() + ">: everything is written as attributes; remove it");
}

const xml::Attribute* Attributes::required(std::string_view name) const {
  const xml::Attribute* a = element_.attribute(name);
  if (a == nullptr) error(4, "<" + element_.name() + "> needs the attribute \"" + std::string(name) + "\"");
  return a != nullptr && a->intact ? a : nullptr;
}

std::optional<double> Attributes::checked(const xml::Attribute& a, std::string_view unit, Sign sign) const {
  if (!a.intact) return std::nullopt;
  const Result<double> value = xml::parse_quantity(a.value, unit);
  if (!value) return wrong(a, value.error().message), std::nullopt;
  if (unit == "m" && std::fabs(*value) > kFarthest) return wrong(a, too_far(a.value)), std::nullopt;
  if (sign == Sign::positive && *value <= 0.0)
    return wrong(a, "\"" + a.value + "\" is not more than 0"), std::nullopt;
  if (sign == Sign::not_negative && *value < 0.0)
    return wrong(a, "\"" + a.value + "\" is negative"), std::nullopt;
  return *value;
}

std::optional<double> Attributes::quantity(std::string_view name, std::string_view unit, Sign sign) const {
  const xml::Attribute* a = required(name);
  return a != nullptr ? checked(*a, unit, sign) : std::nullopt;
}

std::optional<double> Attributes::quantity_or(std::string_view name, std::string_view unit, Sign sign,
                                              double otherwise) const {
  const xml::Attribute* a = element_.attribute(name);
  return a != nullptr ? checked(*a, unit, sign) : std::optional(otherwise);
}

std::optional<Duration> Attributes::duration(std::string_view name, Sign sign) const {
  const xml::Attribute* a = required(name);
  if (a == nullptr) return std::nullopt;
  const Result<Duration> value = xml::parse_duration(a->value);
  if (!value) return wrong(*a, value.error().message), std::nullopt;
  if (sign == Sign::positive && value->count() <= 0)
    return wrong(*a, "\"" + a->value + "\" is not more than 0 s"), std::nullopt;
  return *value;
}

std::optional<Duration> Attributes::duration_or(std::string_view name, Duration otherwise) const {
  return has(name) ? duration(name, Sign::not_negative) : std::optional(otherwise);
}

std::optional<std::size_t> Attributes::count(std::string_view name, std::size_t low, std::size_t high) const {
  const xml::Attribute* a = required(name);
  if (a == nullptr) return std::nullopt;
  const Result<std::int64_t> value = xml::parse_integer(a->value);
  if (!value) return wrong(*a, value.error().message), std::nullopt;
  if (*value < static_cast<std::int64_t>(low) || *value > static_cast<std::int64_t>(high))
    return wrong(*a, "\"" + a->value + "\" is not between " + std::to_string(low) + " and " +
                         std::to_string(high)),
           std::nullopt;
  return static_cast<std::size_t>(*value);
}

std::optional<Vec2> Attributes::point_in(const xml::Attribute& a, std::string_view text) const {
  const bool comma = text.find(',') != std::string_view::npos;
  auto pieces = split(text, comma ? "," : " \t\n\r");
  std::erase(pieces, std::string_view{});
  const auto bad = [&](const std::string& why) {
    wrong(a, "\"" + std::string(text) + "\" is not a point" + why +
                 "; write \"x y\" in metres, or with units \"1.5 m, 250 mm\"");
    return std::nullopt;
  };
  if (pieces.size() != 2) return bad("");
  const Result<double> x = comma ? xml::parse_quantity(pieces[0], "m") : xml::parse_number(pieces[0]);
  const Result<double> y = comma ? xml::parse_quantity(pieces[1], "m") : xml::parse_number(pieces[1]);
  if (!x || !y) return bad(" (" + (x ? y : x).error().message + ")");
  if (std::fmax(std::fabs(*x), std::fabs(*y)) > kFarthest) return wrong(a, too_far(text)), std::nullopt;
  return Vec2{*x, *y};
}

std::optional<Vec2> Attributes::point(std::string_view name) const {
  const xml::Attribute* a = required(name);
  return a != nullptr ? point_in(*a, xml::trimmed(a->value)) : std::nullopt;
}

std::optional<std::vector<Vec2>> Attributes::points(std::string_view name) const {
  const xml::Attribute* a = required(name);
  if (a == nullptr) return std::nullopt;
  std::vector<Vec2> points;
  for (const std::string_view piece : split(a->value, ";")) {
    const auto p = point_in(*a, piece);
    if (!p) return std::nullopt;
    points.push_back(*p);
  }
  return points;
}

std::optional<std::string> Attributes::choice(std::string_view name,
                                              const std::vector<std::string>& choices) const {
  const xml::Attribute* a = required(name);
  if (a == nullptr) return std::nullopt;
  if (among(choices, a->value)) return a->value;
  return wrong(*a, "\"" + a->value + "\" is not known" + help(a->value, choices, "known are")), std::nullopt;
}

std::optional<std::vector<double>> Attributes::exactly(const xml::Attribute& a, std::size_t n,
                                                       std::vector<double> values) const {
  if (values.size() == n) return values;
  return wrong(a, "\"" + a.value + "\" holds " + std::to_string(values.size()) + " numbers, expected " +
                      std::to_string(n)),
         std::nullopt;
}

std::optional<std::vector<double>> Attributes::numbers(std::string_view name, std::size_t n) const {
  const xml::Attribute* a = required(name);
  if (a == nullptr) return std::nullopt;
  std::vector<double> values;
  for (const std::string_view piece : words(a->value)) {
    const Result<double> value = xml::parse_number(piece);
    if (!value) return wrong(*a, value.error().message), std::nullopt;
    values.push_back(*value);
  }
  return exactly(*a, n, std::move(values));
}

std::optional<std::vector<double>> Attributes::quantities(std::string_view name, std::string_view unit,
                                                          std::size_t n) const {
  const xml::Attribute* a = required(name);
  if (a == nullptr) return std::nullopt;
  auto pieces = words(a->value);
  std::string suffix;
  if (!pieces.empty() && !xml::parse_number(pieces.back())) {
    suffix = " " + std::string(pieces.back());
    pieces.pop_back();
  }
  std::vector<double> values;
  for (const std::string_view piece : pieces) {
    const Result<double> value = xml::parse_quantity(std::string(piece) + suffix, unit);
    if (!value) return wrong(*a, value.error().message), std::nullopt;
    values.push_back(*value);
  }
  return exactly(*a, n, std::move(values));
}

std::optional<double> Attributes::number(std::string_view name) const {
  const auto one = numbers(name, 1);
  return one ? std::optional(one->front()) : std::nullopt;
}

std::optional<std::string> Attributes::name(std::string_view attribute) const {
  const xml::Attribute* a = required(attribute);
  if (a == nullptr || is_name(a->value)) return a == nullptr ? std::nullopt : std::optional(a->value);
  return wrong(*a, "\"" + a->value + "\" is not a name: a letter, then letters, digits and _, at most 200"),
         std::nullopt;
}

std::optional<std::string> Attributes::text(std::string_view name) const {
  const xml::Attribute* a = required(name);
  return a == nullptr ? std::nullopt : std::optional(a->value);
}

std::string Attributes::text_or(std::string_view name, std::string otherwise) const {
  const xml::Attribute* a = element_.attribute(name);
  return a == nullptr ? otherwise : a->value;
}

}  // namespace orca::sim::detail
