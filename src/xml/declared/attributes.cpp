// SPDX-License-Identifier: LGPL-3.0-or-later
#include "orca/xml/attributes.hpp"

#include <algorithm>

#include "orca/base/text.hpp"
#include "orca/xml/number.hpp"
#include "orca/xml/quantity.hpp"

namespace orca::xml {
namespace {

bool is_declared_name(std::string_view text) {
  constexpr std::size_t kLongestName = 200;
  const auto letter = [](char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z'); };
  const auto inner = [&](char c) { return letter(c) || (c >= '0' && c <= '9') || c == '_'; };
  return !text.empty() && text.size() <= kLongestName && letter(text.front()) &&
         std::ranges::all_of(text, inner);
}

MatchedAttributes all_of(const Element& element) {
  MatchedAttributes all;
  for (const Attribute& attribute : element.attributes()) all.emplace_back(attribute.name, &attribute);
  return all;
}

}  // namespace

std::vector<std::string_view> split(std::string_view text, std::string_view separators) {
  std::vector<std::string_view> pieces;
  for (auto start = text.begin();;) {
    const auto end = std::ranges::find_first_of(start, text.end(), separators.begin(), separators.end());
    pieces.push_back(trimmed({start, end}));
    if (end == text.end()) return pieces;
    start = end + 1;
  }
}

std::vector<std::string_view> words(std::string_view text) {
  std::vector<std::string_view> pieces = split(text, " \t\n\r");
  std::erase(pieces, std::string_view{});
  return pieces;
}

Attributes::Attributes(const Element& element, const ElementRule& rule, const FileRules& file,
                       Reporter& reporter)
    : element_(element),
      rule_(&rule),
      file_(file),
      reporter_(reporter),
      matched_(match_attributes(element, rule, file, reporter)) {
  check_text(element, file, reporter);
}

Attributes::Attributes(const Element& element, const FileRules& file, Reporter& reporter)
    : element_(element), file_(file), reporter_(reporter), matched_(all_of(element)) {}

void Attributes::error(const char* code, std::string message) const {
  reporter_.error(code, element_.position(), std::move(message));
}

void Attributes::error_at(std::string_view name, const char* code, std::string message) const {
  const Attribute* a = attribute(name);
  reporter_.error(code, a != nullptr ? a->value_position : element_.position(), std::move(message));
}

std::nullopt_t Attributes::refuse(const char* code, std::string message) const {
  error(code, std::move(message));
  return std::nullopt;
}

std::nullopt_t Attributes::refuse_at(std::string_view name, const char* code, std::string message) const {
  error_at(name, code, std::move(message));
  return std::nullopt;
}

std::nullopt_t Attributes::refuse_value(const Attribute& attribute, const ValueFault& fault) const {
  reporter_.error(code_of(fault.kind, file_.codes), attribute.value_position,
                  attribute.name + ": " + fault.message);
  return std::nullopt;
}

const Attribute* Attributes::attribute(std::string_view name) const {
  const auto found = std::ranges::find(matched_, name, &MatchedAttributes::value_type::first);
  return found == matched_.end() ? nullptr : found->second;
}

const Attribute* Attributes::readable(std::string_view name) const {
  const Attribute* a = attribute(name);
  return a != nullptr && a->intact ? a : nullptr;
}

bool Attributes::require(std::string_view name) const {
  if (has(name)) return true;
  error(file_.codes.missing_attribute, "<" + element_.name() + "> needs the attribute " + in_quotes(name));
  return false;
}

std::vector<std::pair<const Element*, const ElementRule*>> Attributes::children() const {
  std::vector<std::pair<const Element*, const ElementRule*>> result;
  for (const Element& child : element_.children())
    if (const ElementRule* rule = match_child(child, *rule_, file_, reporter_))
      result.emplace_back(&child, rule);
  return result;
}

ValueRule Attributes::rule_of(std::string_view name) const {
  const AttributeRule* declared = rule_ == nullptr ? nullptr : rule_->attribute(name);
  return declared == nullptr ? ValueRule{} : declared->value;
}

std::optional<double> Attributes::number(std::string_view name) const {
  const Attribute* a = readable(name);
  if (a == nullptr) return std::nullopt;
  ValueFault fault;
  const auto value = read_number(a->value, rule_of(name), fault);
  return value ? value : refuse_value(*a, fault);
}

std::optional<double> Attributes::number_or(std::string_view name, double otherwise) const {
  return has(name) ? number(name) : otherwise;
}

std::optional<std::int64_t> Attributes::integer(std::string_view name) const {
  return integer(name, rule_of(name));
}

std::optional<std::int64_t> Attributes::integer(std::string_view name, const ValueRule& rule) const {
  const Attribute* a = readable(name);
  if (a == nullptr) return std::nullopt;
  ValueFault fault;
  const auto value = read_integer(a->value, rule, fault);
  return value ? value : refuse_value(*a, fault);
}

std::optional<std::string> Attributes::choice(std::string_view name) const {
  return choice(name, rule_of(name));
}

std::optional<std::string> Attributes::choice(std::string_view name, const ValueRule& rule) const {
  const Attribute* a = readable(name);
  if (a == nullptr) return std::nullopt;
  const std::vector<std::string> choices(rule.choices.begin(), rule.choices.end());
  if (std::ranges::find(choices, a->value) != choices.end()) return a->value;
  return refuse_value(
      *a, {ValueFault::Kind::choice,
           in_quotes(a->value) + " is not one of: " + listed(choices) + reporter_.hint(a->value, choices)});
}

std::optional<std::string> Attributes::name(std::string_view attribute) const {
  const Attribute* a = readable(attribute);
  if (a == nullptr || is_declared_name(a->value)) return text(attribute);
  return refuse_value(
      *a, {ValueFault::Kind::form,
           in_quotes(a->value) + " is not a name: a letter, then letters, digits and _, at most 200"});
}

std::optional<std::string> Attributes::text(std::string_view name) const {
  const Attribute* a = readable(name);
  return a == nullptr ? std::nullopt : std::optional(a->value);
}

std::optional<std::vector<double>> Attributes::exactly(const Attribute& a, std::size_t n,
                                                       std::vector<double> values) const {
  if (values.size() == n) return values;
  return refuse_value(
      a, {ValueFault::Kind::form, in_quotes(a.value) + " holds " + std::to_string(values.size()) +
                                      " numbers, expected " + std::to_string(n)});
}

std::optional<double> Attributes::bare_number(std::string_view name) const {
  const Attribute* a = readable(name);
  if (a == nullptr) return std::nullopt;
  const Result<double> value = parse_number(a->value);
  if (!value) return refuse_value(*a, {ValueFault::Kind::form, value.error().message});
  return *value;
}

std::optional<std::vector<double>> Attributes::bare_numbers(std::string_view name, std::size_t n) const {
  const Attribute* a = readable(name);
  if (a == nullptr) return std::nullopt;
  std::vector<double> values;
  for (const std::string_view piece : words(a->value)) {
    const Result<double> value = parse_number(piece);
    if (!value) return refuse_value(*a, {ValueFault::Kind::form, value.error().message});
    values.push_back(*value);
  }
  return exactly(*a, n, std::move(values));
}

std::optional<std::vector<double>> Attributes::numbers(std::string_view name, std::size_t n) const {
  const Attribute* a = readable(name);
  if (a == nullptr) return std::nullopt;
  std::vector<double> values;
  for (const std::string& piece : split_quantities(a->value)) {
    ValueFault fault;
    const auto value = read_number(piece, rule_of(name), fault);
    if (!value) return refuse_value(*a, fault);
    values.push_back(*value);
  }
  return exactly(*a, n, std::move(values));
}

std::optional<Duration> Attributes::duration(std::string_view name) const {
  const auto seconds = number(name);
  return seconds ? std::optional(from_seconds(*seconds)) : std::nullopt;
}

std::optional<Duration> Attributes::duration_or(std::string_view name, Duration otherwise) const {
  return has(name) ? duration(name) : otherwise;
}

}  // namespace orca::xml
