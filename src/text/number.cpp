// SPDX-License-Identifier: LGPL-3.0-or-later
#include "number.hpp"

#include <array>
#include <bit>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <limits>

#include "codes.hpp"
#include "orca/xml/number.hpp"
#include "orca/xml/quantity.hpp"

namespace orca::text {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

std::string nan_text(std::uint64_t bits) {
  if (bits == std::bit_cast<std::uint64_t>(kNan)) return "nan";
  std::array<char, 16> digits{};
  const auto end = std::to_chars(digits.data(), digits.data() + digits.size(), bits, 16).ptr;
  return "nan(" + std::string(digits.data(), end) + ")";
}

// Reads "nan(BITS)".
std::optional<double> nan_of_bits(std::string_view word) {
  if (!word.starts_with("nan(") || !word.ends_with(')')) return std::nullopt;
  const char* end = word.data() + word.size() - 1;
  std::uint64_t bits = 0;
  const auto [stop, problem] = std::from_chars(word.data() + 4, end, bits, 16);
  const auto value = std::bit_cast<double>(bits);
  if (stop != end || problem != std::errc{} || !std::isnan(value)) return std::nullopt;
  return value;
}

std::optional<double> not_finite(std::string_view word) {
  if (word == "nan") return kNan;
  if (word == "inf" || word == "+inf") return kInfinity;
  if (word == "-inf") return -kInfinity;
  return nan_of_bits(word);
}

Result<xml::LeadingNumber> leading_number(std::string_view text) {
  const std::string_view inner = xml::trimmed(text);
  const std::string_view word = inner.substr(0, inner.find_first_of(" \t\r\n"));
  const std::optional<double> special = not_finite(word);
  if (!special) return xml::parse_leading_number(text);
  return xml::LeadingNumber{*special, xml::trimmed(inner.substr(word.size()))};
}

}  // namespace

std::string number_text(double value) {
  if (std::isnan(value)) return nan_text(std::bit_cast<std::uint64_t>(value));
  if (std::isinf(value)) return value > 0 ? "inf" : "-inf";
  return xml::number_text(value);
}

bool starts_number(std::string_view word) {
  if (word.starts_with("nan") || word.starts_with("inf")) return true;
  return word.find_first_of("0123456789+-.") == 0;
}

Verdict read_number(std::string_view text, std::string_view unit, double& value) {
  const Result<xml::LeadingNumber> number = leading_number(text);
  if (!number) return Problem{codes::kBadValue, number.error().message};
  const std::string shown = "\"" + std::string(text) + "\"";
  if (!number->rest.empty() && unit.find(',') != std::string_view::npos) {
    return Problem{codes::kUnit,
                   shown + ": write numbers alone here, their units differ: " + std::string(unit)};
  }
  // The unit of an infinite value or NaN is checked as well, but there is nothing to convert.
  const bool finite = std::isfinite(number->value);
  const Result<double> si = xml::to_si(finite ? number->value : 0.0, number->rest, unit == "1" ? "" : unit);
  if (!si) return Problem{codes::kUnit, shown + ": " + si.error().message};
  value = finite ? *si : number->value;
  return {};
}

}  // namespace orca::text
