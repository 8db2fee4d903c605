// SPDX-License-Identifier: LGPL-3.0-or-later
#include "properties.hpp"

#include <algorithm>
#include <optional>
#include <utility>

#include "orca/base/text.hpp"
#include "orca/xml/number.hpp"
#include "orca/xml/quantity.hpp"
#include "reading/codes.hpp"
#include "reading/naming.hpp"

namespace orca::graph {
namespace {

bool is_digit(char c) { return c >= '0' && c <= '9'; }
// Returns whether a text begins like a number: with a digit, after a sign and a point if there are any.
bool begins_like_number(std::string_view text) {
  if (!text.empty() && (text.front() == '+' || text.front() == '-')) text.remove_prefix(1);
  if (!text.empty() && text.front() == '.') text.remove_prefix(1);
  return !text.empty() && is_digit(text.front());
}

Result<PropertyValue> read_number(std::string_view text) {
  Result<xml::Measured> read = xml::parse_measured(text);
  if (!read) return read.error();
  return PropertyValue(Quantity{read->value, std::move(read->si)});
}

Result<PropertyValue> read_quoted(std::string_view text) {
  const char quote = text.front();
  const std::size_t end = text.find(quote, 1);
  if (end == std::string_view::npos)
    return fail(Code::invalid_argument, in_quotes(text) + ": the quote is not closed");
  if (end + 1 != text.size())
    return fail(Code::invalid_argument, in_quotes(text) + ": something follows the closing quote");
  return PropertyValue(std::string(text.substr(1, end - 1)));
}

std::string quoted(const std::string& text) {
  const char quote = text.find('\'') == std::string::npos ? '\'' : '"';
  return quote + text + quote;
}

std::string number_text(const Quantity& number) {
  return xml::number_text(number.value) + (number.unit.empty() ? "" : " " + number.unit);
}

// Returns why a component may have no property of that name; nothing if it may.
std::optional<std::string> fault_of(const std::string& name) {
  if (name.find('/') != std::string::npos) return "a property has no contexts, so no '/'";
  if (const auto fault = name_fault(name)) return fault;
  if (std::ranges::find(kImplicitProperties, name) == kImplicitProperties.end()) return std::nullopt;
  return "each component has it anyway, from the graph; take another name";
}

std::optional<PropertyValue> read_one(const Node& component, const Node& property, Report& report) {
  const Text* const text = property.known("value");
  if (text == nullptr) return std::nullopt;
  const auto marked = read_marked_value(xml::trimmed(text->value));
  if (!marked && !xml::trimmed(text->value).empty())
    return PropertyValue(std::string(xml::trimmed(text->value)));
  if (marked && *marked) return **marked;
  const std::string reason = marked
                                 ? marked->error().message + "; if it is a text, put it between quotes: '...'"
                                 : "the value is empty; write true, false, a number with its unit, or a text";
  report.error(codes::kBadValue, text->position, component.title() + ": " + property.title() + ": " + reason);
  return std::nullopt;
}

}  // namespace

std::optional<Result<PropertyValue>> read_marked_value(std::string_view text) {
  if (text.empty()) return std::nullopt;
  if (text == "true" || text == "false") return Result<PropertyValue>(PropertyValue(text == "true"));
  if (is_quote(text.front())) return read_quoted(text);
  if (begins_like_number(text)) return read_number(text);
  return std::nullopt;
}

Properties read_properties(const Node& component, Report& report) {
  Properties properties;
  for (const Node& child : component.children) {
    const Text* const name = child.is("property") ? child.known("name") : nullptr;
    if (name == nullptr) continue;
    if (const auto fault = fault_of(name->value)) {
      report.error(codes::kBadName, name->position,
                   component.title() + ": the property " + in_quotes(name->value) + ": " + *fault);
    } else if (auto value = read_one(component, child, report)) {
      properties.insert_or_assign(name->value, *std::move(value));
    }
  }
  return properties;
}

std::string constraint_text(const PropertyValue& value) {
  if (const auto* flag = std::get_if<bool>(&value)) return *flag ? "true" : "false";
  if (const auto* number = std::get_if<Quantity>(&value)) return number_text(*number);
  return quoted(std::get<std::string>(value));
}

// A text needs its quotes only where it would be read as something else without them.
std::string property_text(const PropertyValue& value) {
  const auto* const text = std::get_if<std::string>(&value);
  if (text == nullptr) return constraint_text(value);
  const bool is_plain = !text->empty() && xml::trimmed(*text) == *text && !read_marked_value(*text);
  return is_plain ? *text : quoted(*text);
}

}  // namespace orca::graph
