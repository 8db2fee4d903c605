// SPDX-License-Identifier: LGPL-3.0-or-later
#include "orca/xml/values.hpp"

#include <cmath>
#include <utility>

#include "orca/base/text.hpp"
#include "orca/xml/number.hpp"
#include "orca/xml/quantity.hpp"

namespace orca::xml {
namespace {

// [s] Times are counted in nanoseconds, by numbers that hold three times as long. As with parse_duration(), it is a hundred years.
constexpr double kLongestTime = 100.0 * 365.25 * 86400.0;

std::nullopt_t refuse(ValueFault& fault, ValueFault::Kind kind, std::string message) {
  fault = {kind, std::move(message)};
  return std::nullopt;
}

// Returns "0.05 to 5 m is allowed", or nothing if everything is allowed.
std::string limit_text(const ValueRule& rule) {
  const bool low = std::isfinite(rule.min);
  const bool high = std::isfinite(rule.max);
  const std::string unit = (rule.unit.empty() ? "" : " ") + std::string(rule.unit);
  const std::string max = number_text(rule.max) + unit + " is allowed";
  if (low && high && rule.above_min) return "more than " + number_text(rule.min) + " and at most " + max;
  if (low && high) return number_text(rule.min) + " to " + max;
  if (low)
    return (rule.above_min ? "more than " : "at least ") + number_text(rule.min) + unit + " is allowed";
  return high ? "at most " + max : "";
}

std::nullopt_t no_number(ValueFault& fault, const Error& error, const ValueRule& rule) {
  const std::string limits = limit_text(rule);
  return refuse(fault, ValueFault::Kind::form, error.message + (limits.empty() ? "" : "; " + limits));
}

bool in_range(double value, const ValueRule& rule) {
  return (rule.above_min ? value > rule.min : value >= rule.min) && value <= rule.max;
}

std::nullopt_t out_of_range(ValueFault& fault, std::string_view text, const ValueRule& rule) {
  return refuse(fault, ValueFault::Kind::range, in_quotes(text) + " is out of range: " + limit_text(rule));
}

}  // namespace

const char* code_of(ValueFault::Kind kind, const RuleCodes& codes) {
  switch (kind) {
    case ValueFault::Kind::form: return codes.bad_value;
    case ValueFault::Kind::unit: return codes.wrong_unit;
    case ValueFault::Kind::range: return codes.out_of_range;
    case ValueFault::Kind::choice: return codes.unknown_choice;
  }
  return codes.bad_value;
}

std::optional<bool> read_boolean(std::string_view text, ValueFault& fault) {
  const std::string_view word = trimmed(text);
  if (word == "true" || word == "false") return word == "true";
  return refuse(fault, ValueFault::Kind::form, in_quotes(text) + " is neither true nor false");
}

std::optional<std::int64_t> read_integer(std::string_view text, const ValueRule& rule, ValueFault& fault) {
  const Result<std::int64_t> value = parse_integer(text);
  if (!value) return no_number(fault, value.error(), rule);
  if (!in_range(static_cast<double>(*value), rule)) return out_of_range(fault, text, rule);
  return *value;
}

std::optional<double> read_number(std::string_view text, const ValueRule& rule, ValueFault& fault) {
  const Result<LeadingNumber> number = parse_leading_number(text);
  if (!number) return no_number(fault, number.error(), rule);
  const Result<double> value = to_si(number->value, number->rest, rule.unit);
  if (!value) return refuse(fault, ValueFault::Kind::unit, in_quotes(text) + ": " + value.error().message);
  if (!in_range(*value, rule)) return out_of_range(fault, text, rule);
  if (rule.unit == "s" && std::fabs(*value) > kLongestTime)
    return refuse(fault, ValueFault::Kind::range,
                  in_quotes(text) + " is out of range: a time of at most a hundred years is allowed");
  return *value;
}

}  // namespace orca::xml
