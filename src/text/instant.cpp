// SPDX-License-Identifier: LGPL-3.0-or-later
#include "instant.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>

#include "codes.hpp"
#include "number.hpp"
#include "orca/xml/number.hpp"

namespace orca::text {
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
