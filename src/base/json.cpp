// SPDX-License-Identifier: LGPL-3.0-or-later
#include "orca/base/json.hpp"

#include <array>
#include <charconv>
#include <cmath>
#include <cstdio>

namespace orca {
namespace {

std::string escaped(char c) {
  switch (c) {
    case '"': return "\\\"";
    case '\\': return "\\\\";
    case '\n': return "\\n";
    case '\t': return "\\t";
    case '\r': return "\\r";
    default: break;
  }
  const auto byte = static_cast<unsigned char>(c);
  if (byte >= 0x20) return {c};
  std::array<char, 8> code{};
  std::snprintf(code.data(), code.size(), "\\u%04x", static_cast<unsigned>(byte));
  return code.data();
}

std::string quoted(std::string_view text) {
  std::string result = "\"";
  for (const char c : text) result += escaped(c);
  return result + "\"";
}

}  // namespace

void JsonWriter::new_line() { text_ += "\n" + std::string(2 * open_.size(), ' '); }

void JsonWriter::separate() {
  if (after_key_) {
    after_key_ = false;
  } else if (!open_.empty()) {
    if (!first_) text_ += ',';
    new_line();
  }
  first_ = false;
}

void JsonWriter::begin(char open, char close) {
  separate();
  text_ += open;
  open_.push_back(close);
  first_ = true;
}

void JsonWriter::end() {
  const char close = open_.back();
  open_.pop_back();
  if (!first_) new_line();
  text_ += close;
  first_ = false;
}

JsonWriter& JsonWriter::key(std::string_view name) {
  separate();
  text_ += quoted(name) + ": ";
  after_key_ = true;
  return *this;
}

void JsonWriter::raw(std::string_view json) {
  separate();
  text_ += json;
}

void JsonWriter::value(std::string_view text) { raw(quoted(text)); }

void JsonWriter::value(double number) {
  if (!std::isfinite(number)) return raw("null");
  std::array<char, 32> digits{};
  const auto end = std::to_chars(digits.data(), digits.data() + digits.size(), number).ptr;
  raw({digits.data(), static_cast<std::size_t>(end - digits.data())});
}

void JsonWriter::value(const std::vector<std::string>& texts) {
  begin_array();
  for (const std::string& text : texts) value(text);
  end();
}

}  // namespace orca
