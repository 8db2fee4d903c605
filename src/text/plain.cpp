// SPDX-License-Identifier: LGPL-3.0-or-later
#include "plain.hpp"

#include <algorithm>
#include <bit>
#include <charconv>
#include <concepts>
#include <cstdint>
#include <limits>
#include <string>
#include <string_view>
#include <vector>

#include "codes.hpp"
#include "number.hpp"
#include "orca/base/text.hpp"
#include "orca/idl/generated/time.h"
#include "orca/xml/document.hpp"
#include "orca/xml/names.hpp"
#include "orca/xml/number.hpp"

namespace orca::text {
namespace {

constexpr std::string_view kDigits = "0123456789abcdef";

std::string as_byte(char c) {
  const auto byte = static_cast<unsigned char>(c);
  return {'\\', 'x', kDigits[byte >> 4U], kDigits[byte & 0xFU]};
}

// Returns the byte that two hexadecimal digits mean.
std::optional<char> hexadecimal(std::string_view digits) {
  std::uint8_t byte = 0;
  const char* end = digits.data() + digits.size();
  const auto [stop, problem] = std::from_chars(digits.data(), end, byte, 16);
  if (digits.size() != 2 || problem != std::errc{} || stop != end) return std::nullopt;
  return static_cast<char>(byte);
}

// Returns any bytes as characters that XML can hold. A backslash becomes \\. A byte that is part of no XML
// character (control characters, broken UTF-8) becomes \x and two hexadecimal digits.
std::string with_backslashes(std::string_view bytes) {
  std::string text;
  while (!bytes.empty()) {
    const std::size_t size = xml::character_size(bytes);
    const std::size_t taken = size == 0 ? 1 : size;
    if (bytes.front() == '\\') text += '\\';
    text += size == 0 ? as_byte(bytes.front()) : std::string(bytes.substr(0, size));
    bytes.remove_prefix(taken);
  }
  return text;
}

// Reads the bytes back from what with_backslashes() wrote.
Verdict without_backslashes(std::string_view text, std::string& bytes) {
  bytes.clear();
  for (std::size_t at = text.find('\\'); at != std::string_view::npos; at = text.find('\\')) {
    bytes += text.substr(0, at);
    text.remove_prefix(at + 1);
    const std::optional<char> byte = text.starts_with('x') ? hexadecimal(text.substr(1, 2)) : std::nullopt;
    if (!byte && !text.starts_with('\\')) {
      return Problem{codes::kBackslash,
                     "a backslash is written \\\\, any other byte \\x and two digits: \\x1b"};
    }
    bytes += byte.value_or('\\');
    text.remove_prefix(byte ? 3 : 1);
  }
  bytes += text;
  return {};
}

std::vector<std::string_view> words_of(std::string_view text) {
  constexpr std::string_view kBlank = " \t\r\n";
  std::vector<std::string_view> words;
  std::size_t at = text.find_first_not_of(kBlank);
  while (at != std::string_view::npos) {
    const std::size_t end = std::min(text.find_first_of(kBlank, at), text.size());
    words.push_back(text.substr(at, end - at));
    at = text.find_first_not_of(kBlank, end);
  }
  return words;
}

// -- is_default

class DefaultCheck final : public FieldVisitor {
 public:
  void field(const FieldInfo&, const Value& value) override { all_ = all_ && is_default(value); }
  [[nodiscard]] bool all() const { return all_; }

 private:
  bool all_ = true;
};

struct IsDefault {
  template <std::integral T>
  bool operator()(const T* value) const {
    return *value == T{};
  }
  bool operator()(const double* value) const { return std::bit_cast<std::uint64_t>(*value) == 0; }
  bool operator()(const std::string* value) const { return value->empty(); }
  bool operator()(const idl::TimeValue* value) const { return value->ns() == 0; }
  bool operator()(const EnumValue& value) const { return value.get(value.place) == 0; }
  bool operator()(const StructValue& value) const {
    DefaultCheck check;
    value.fields(value.object, check);
    return check.all();
  }
  bool operator()(const ListValue& value) const {
    const std::size_t count = value.size(value.list);
    if (value.resize != nullptr) return count == 0;
    for (std::size_t i = 0; i < count; ++i)
      if (!is_default(value.at(value.list, i))) return false;
    return true;
  }
};

// -- plain_text

struct PlainText {
  std::string operator()(const bool* value) const { return *value ? "true" : "false"; }
  template <std::integral T>
  std::string operator()(const T* value) const {
    return std::to_string(*value);
  }
  std::string operator()(const double* value) const { return number_text(*value); }
  std::string operator()(const std::string* value) const { return with_backslashes(*value); }
  std::string operator()(const idl::TimeValue* value) const { return instant_text(value->ns()); }
  std::string operator()(const EnumValue& value) const {
    const std::uint32_t number = value.get(value.place);
    return number < value.names.size() ? std::string(value.names[number]) : std::to_string(number);
  }
  std::string operator()(const StructValue&) const { return {}; }
  std::string operator()(const ListValue& value) const {
    std::string text;
    for (std::size_t i = 0; i < value.size(value.list); ++i) {
      if (i > 0) text += ' ';
      text += plain_text(value.at(value.list, i));
    }
    return text;
  }
};

// -- read_plain

template <std::integral T>
Problem out_of_range(std::string_view text) {
  using Limits = std::numeric_limits<T>;
  return {codes::kRange, in_quotes(text) + " is not between " + std::to_string(Limits::min()) + " and " +
                             std::to_string(Limits::max())};
}

bool is_whole_number(std::string_view text) {
  if (text.starts_with('-') || text.starts_with('+')) text.remove_prefix(1);
  const auto digit = [](char c) { return c >= '0' && c <= '9'; };
  return !text.empty() && std::ranges::all_of(text, digit);
}

struct ReadPlain {
  std::string_view text;
  std::string_view unit;

  Verdict operator()(bool* value) const {
    const std::string_view word = xml::trimmed(text);
    if (word != "true" && word != "false") {
      return Problem{codes::kBadValue, in_quotes(text) + " is neither true nor false"};
    }
    *value = word == "true";
    return {};
  }

  template <std::integral T>
  Verdict operator()(T* value) const {
    std::string_view digits = xml::trimmed(text);
    if (!is_whole_number(digits)) {
      return Problem{codes::kBadValue,
                     in_quotes(text) + " is not a whole number: digits only, no point and no unit"};
    }
    if (digits.starts_with('+')) digits.remove_prefix(1);
    const auto problem = std::from_chars(digits.data(), digits.data() + digits.size(), *value).ec;
    if (problem != std::errc{}) return out_of_range<T>(text);
    return {};
  }

  Verdict operator()(double* value) const { return read_number(text, unit, *value); }
  Verdict operator()(std::string* value) const { return without_backslashes(text, *value); }

  Verdict operator()(idl::TimeValue* value) const {
    std::int64_t ns = value->ns();
    Verdict verdict = read_instant(text, ns);
    value->ns(ns);
    return verdict;
  }

  Verdict operator()(const EnumValue& value) const {
    const std::string_view word = xml::trimmed(text);
    const auto found = std::ranges::find(value.names, word);
    if (found != value.names.end()) {
      value.set(value.place, static_cast<std::uint32_t>(found - value.names.begin()));
      return {};
    }
    const std::vector<std::string> names(value.names.begin(), value.names.end());
    return Problem{codes::kChoice, in_quotes(text) + " is no " + std::string(value.type) + "; there are: " +
                                       listed(names) + xml::did_you_mean(xml::nearest_name(word, names))};
  }

  Verdict operator()(const StructValue&) const { return {}; }
  Verdict operator()(const ListValue& list) const;
};

// Takes the unit off "150 200 mm": the unit at the end holds for all numbers.
std::string take_common_unit(std::vector<std::string_view>& words, std::string_view unit) {
  if (unit.empty() || words.size() < 2) return {};
  const std::string_view last = words.back();
  const bool is_unit = last == unit && unit != "1";  // "1/s" starts like a number.
  if (starts_number(last) && !is_unit) return {};
  words.pop_back();
  return " " + std::string(last);
}

Verdict ReadPlain::operator()(const ListValue& list) const {
  std::vector<std::string_view> words = words_of(text);
  const std::string common = take_common_unit(words, unit);
  if (list.resize != nullptr) {
    list.resize(list.list, words.size());
  } else if (words.size() != list.size(list.list)) {
    return Problem{codes::kCount, std::to_string(list.size(list.list)) +
                                      " values with blanks between them are expected, found " +
                                      std::to_string(words.size())};
  }
  for (std::size_t i = 0; i < words.size(); ++i) {
    const std::string word = std::string(words[i]) + common;
    const Verdict wrong = read_plain(word, unit, list.at(list.list, i));
    if (wrong) return Problem{wrong->code, "value " + std::to_string(i + 1) + ": " + wrong->message};
  }
  return {};
}

}  // namespace

bool is_attribute(const Value& value) {
  if (const auto* list = std::get_if<ListValue>(&value.of)) return list->kind == ElementKind::plain;
  return !std::holds_alternative<StructValue>(value.of);
}

bool is_default(const Value& value) { return std::visit(IsDefault{}, value.of); }

std::string plain_text(const Value& value) { return std::visit(PlainText{}, value.of); }

Verdict read_plain(std::string_view text, std::string_view unit, const Value& value) {
  return std::visit(ReadPlain{text, unit}, value.of);
}

}  // namespace orca::text
