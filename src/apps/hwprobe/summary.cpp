// SPDX-License-Identifier: GPL-3.0-or-later
// Additional permission: LICENSES/Orca-plugin-exception.txt
#include "summary.hpp"

#include <algorithm>
#include <array>
#include <cstdio>
#include <map>
#include <optional>
#include <sstream>

#include "orca/xml/document.hpp"
#include "orca/xml/number.hpp"

namespace orca::hwprobe {
namespace {

constexpr std::size_t kLongestList = 64;  // of which each number is shown
constexpr std::array kUntold{"creation_time", "origin", "seq", "mission", "stamp", "stamps"};

std::string rounded(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.4g", value);
  return text;
}

// Words that are no finite numbers, such as names and "inf", stay as they are.
std::string rounded(const std::string& word) {
  const Result<double> value = xml::parse_number(word);
  return value ? rounded(*value) : word;
}

std::vector<std::string> words_of(const std::string& text) {
  std::istringstream in(text);
  std::vector<std::string> words;
  for (std::string word; in >> word;) words.push_back(word);
  return words;
}

// What a long list holds, by its finite numbers.
std::string overview(const std::vector<std::string>& words) {
  std::optional<std::size_t> smallest;
  double low = 0.0;
  double high = 0.0;
  for (std::size_t i = 0; i < words.size(); ++i) {
    const Result<double> value = xml::parse_number(words[i]);
    if (!value) continue;
    if (!smallest) high = *value;
    if (!smallest || *value < low) {
      smallest = i;
      low = *value;
    }
    high = std::max(high, *value);
  }
  const std::string count = std::to_string(words.size()) + " values";
  if (!smallest) return count;
  return count + " from " + rounded(low) + " to " + rounded(high) + ", the smallest is number " +
         std::to_string(*smallest + 1);
}

std::string value_text(const std::string& value) {
  const std::vector<std::string> words = words_of(value);
  if (words.size() > kLongestList) return overview(words);
  std::string text;
  for (const std::string& word : words) text += (text.empty() ? "" : " ") + rounded(word);
  return text;
}

}  // namespace

std::vector<std::string> summary(const std::string& xml) {
  xml::Diagnostics diagnostics;
  const std::optional<xml::Document> document = xml::read_text(xml, "object", diagnostics);
  if (!document) return {xml};
  const xml::Element& object = document->root;
  std::string single;
  std::vector<std::string> lines;
  for (const xml::Attribute& field : object.attributes()) {
    if (std::ranges::find(kUntold, field.name) != kUntold.end()) continue;
    if (field.value.empty() || field.value == "nan") continue;  // not known
    const bool is_list = words_of(field.value).size() > 1;
    if (is_list) lines.push_back("  " + field.name + " " + value_text(field.value));
    if (!is_list) single += (single.empty() ? ": " : ", ") + field.name + " " + value_text(field.value);
  }
  lines.insert(lines.begin(), object.name() + single);
  std::map<std::string, std::size_t> inside;
  for (const xml::Element& child : object.children()) ++inside[child.name()];
  for (const auto& [name, count] : inside)
    lines.push_back("  " + name + (count > 1 ? ", " + std::to_string(count) + " of them" : ""));
  return lines;
}

}  // namespace orca::hwprobe
