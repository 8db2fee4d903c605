// SPDX-License-Identifier: LGPL-3.0-or-later
#include "number.hpp"

#include <algorithm>
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

namespace {

constexpr std::uint64_t kNsPerSecond = 1'000'000'000;
constexpr std::size_t kFractionDigits = 9;

bool all_digits(std::string_view text) {
  return std::ranges::all_of(text, [](char c) { return c >= '0' && c <= '9'; });
}

// Reads the nanoseconds of "12" or "12.05"; at most nine digits after the point.
std::optional<std::uint64_t> nanoseconds(std::string_view seconds) {
  const std::size_t point = std::min(seconds.find('.'), seconds.size());
  const std::string_view whole = seconds.substr(0, point);
  const std::string_view fraction = seconds.substr(std::min(point + 1, seconds.size()));
  if (whole.empty() || fraction.size() > kFractionDigits) return std::nullopt;
  if (!all_digits(whole) || !all_digits(fraction)) return std::nullopt;
  std::string digits(whole);
  digits += fraction;
  digits.append(kFractionDigits - fraction.size(), '0');
  std::uint64_t ns = 0;
  const auto problem = std::from_chars(digits.data(), digits.data() + digits.size(), ns).ec;
  return problem == std::errc{} ? std::optional(ns) : std::nullopt;
}

std::optional<std::int64_t> exact(std::string_view text) {
  text = xml::trimmed(text);
  if (text.ends_with('s')) text = xml::trimmed(text.substr(0, text.size() - 1));
  const bool negative = text.starts_with('-');
  if (negative || text.starts_with('+')) text.remove_prefix(1);
  const std::optional<std::uint64_t> size = nanoseconds(text);
  const std::uint64_t limit = std::uint64_t{INT64_MAX} + (negative ? 1 : 0);
  if (!size || *size > limit) return std::nullopt;
  return static_cast<std::int64_t>(negative ? 0 - *size : *size);
}

}  // namespace

std::string instant_text(std::int64_t ns) {
  const auto bits = static_cast<std::uint64_t>(ns);
  const std::uint64_t size = ns < 0 ? 0 - bits : bits;
  std::string text = (ns < 0 ? "-" : "") + std::to_string(size / kNsPerSecond);
  std::string fraction = std::to_string(size % kNsPerSecond);
  fraction.insert(0, kFractionDigits - fraction.size(), '0');
  fraction.erase(fraction.find_last_not_of('0') + 1);
  return fraction.empty() ? text : text + "." + fraction;
}

Verdict read_instant(std::string_view text, std::int64_t& ns) {
  if (const auto value = exact(text)) {
    ns = *value;
    return {};
  }
  double seconds = 0.0;
  if (const Verdict wrong = read_number(text, "s", seconds)) return wrong;
  constexpr double kLimit = 9.2e9;  // 2^63 ns is a little more.
  if (!(std::abs(seconds) <= kLimit)) {
    return Problem{codes::kRange,
                   "\"" + std::string(text) + "\" is not within 292 years of the clock's zero"};
  }
  ns = std::llround(seconds * static_cast<double>(kNsPerSecond));
  return {};
}

}  // namespace orca::text
