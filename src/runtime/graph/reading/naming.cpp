// SPDX-License-Identifier: LGPL-3.0-or-later
#include "naming.hpp"

#include "orca/xml/number.hpp"
#include "report.hpp"

namespace orca::graph {
namespace {

constexpr std::size_t kLongestName = 200;
constexpr std::string_view kRule =
    "; a name is a letter followed by letters, digits and '_', and contexts are joined by '/'";

bool is_letter(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z'); }
bool is_digit(char c) { return c >= '0' && c <= '9'; }

// Returns a character as people see it, with all its bytes.
std::string character_at(std::string_view text, std::size_t at) {
  std::size_t end = at + 1;
  while (end < text.size() && (static_cast<unsigned char>(text[end]) & 0xC0U) == 0x80U) ++end;
  return std::string(text.substr(at, end - at));
}

std::string not_allowed(std::string_view name, std::size_t at) {
  const std::string found = "'" + character_at(name, at) + "'";
  const bool known = is_letter(name[at]) || is_digit(name[at]) || name[at] == '_' || name[at] == '/';
  return (known ? found + " may not start a name" : found + " is not allowed in a name") + std::string(kRule);
}

std::vector<std::string> split(std::string_view text, std::string_view separators) {
  std::vector<std::string> parts;
  std::size_t begin = 0;
  while (begin <= text.size()) {
    const std::size_t end = std::min(text.find_first_of(separators, begin), text.size());
    parts.emplace_back(xml::trimmed(text.substr(begin, end - begin)));
    begin = end + 1;
  }
  return parts;
}

}  // namespace

std::optional<std::string> name_fault(std::string_view name) {
  if (name.empty()) return "the name is empty" + std::string(kRule);
  if (name.size() > kLongestName) {
    return "the name has " + std::to_string(name.size()) + " characters, at most " +
           std::to_string(kLongestName) + " are allowed";
  }
  bool starts = true;
  for (std::size_t i = 0; i < name.size(); ++i) {
    const char c = name[i];
    const bool fits = is_letter(c) || (!starts && (is_digit(c) || c == '_' || c == '/'));
    if (!fits) return not_allowed(name, i);
    starts = c == '/';
  }
  if (starts) return "the name ends with '/'" + std::string(kRule);
  return std::nullopt;
}

std::vector<std::string> split_names(std::string_view text) {
  std::vector<std::string> names = split(text, " \t\r\n,;");
  std::erase(names, "");
  return names;
}

std::vector<std::string> split_list(std::string_view text) {
  if (xml::trimmed(text).empty()) return {};
  return split(text, ";");
}

}  // namespace orca::graph
