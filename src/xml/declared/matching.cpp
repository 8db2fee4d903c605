// SPDX-License-Identifier: LGPL-3.0-or-later
#include "orca/xml/matching.hpp"

#include <algorithm>
#include <optional>
#include <string>

#include "blanks.hpp"
#include "orca/base/text.hpp"
#include "orca/xml/names.hpp"
#include "orca/xml/number.hpp"

namespace orca::xml {
namespace {

std::string tag(std::string_view name) {
  constexpr std::size_t kMost = 200;
  return "<" + shortened(name, kMost) + ">";
}

bool among(std::span<const std::string_view> names, std::string_view name) {
  return std::ranges::find(names, name) != names.end();
}

// Returns at most that many bytes of the text; no character is cut in two.
std::string beginning_of(std::string_view text, std::size_t length) {
  while (length > 0 && (static_cast<unsigned char>(text[length]) & 0xC0U) == 0x80U) --length;
  return std::string(text.substr(0, length));
}

// Returns the rule of the attribute. An unknown attribute gets the rule of the one that was meant, unless
// that one is there as well. Null if there is none.
const AttributeRule* match(const Attribute& attribute, const Element& element, const ElementRule& rule,
                           const FileRules& file, Reporter& reporter) {
  if (const AttributeRule* known = rule.attribute(attribute.name)) return known;
  const std::vector<std::string> names = rule.attribute_names();
  const auto near = reporter.nearest(attribute.name, names);
  reporter.error(file.codes.unknown_attribute, attribute.position,
                 tag(element.name()) + " has no attribute " + in_quotes(attribute.name) +
                     "; it has: " + listed(names) + did_you_mean(near));
  return near && element.attribute(*near) == nullptr ? rule.attribute(*near) : nullptr;
}

bool is_matched(const MatchedAttributes& matched, std::string_view name) {
  return std::ranges::find(matched, name, &MatchedAttributes::value_type::first) != matched.end();
}

// Guesses the child that an unknown element was meant to be: the one with the nearest name, or the one that
// its attributes identify. Null if neither helps.
const ElementRule* guess(const Element& element, const ElementRule& parent) {
  if (const auto near = nearest_name(element.name(), parent.child_names())) return parent.child(*near);
  const auto is_told = [&](const ElementRule* rule) {
    const auto has = [&](std::string_view name) { return element.attribute(name) != nullptr; };
    return !rule->telling.empty() && std::ranges::all_of(rule->telling, has);
  };
  const auto found = std::ranges::find_if(parent.children, is_told);
  return found == parent.children.end() ? nullptr : *found;
}

void report_misplaced(const Element& child, const ElementRule& parent, const FileRules& file,
                      Reporter& reporter) {
  const bool root = child.name() == file.elements.front()->name;
  reporter.error(
      file.codes.misplaced_element, child.position(),
      tag(child.name()) + " does not belong in " + tag(parent.name) +
          (root ? "; it is the root of the file" : "; it goes into " + file.parents_of(child.name())));
}

}  // namespace

MatchedAttributes match_attributes(const Element& element, const ElementRule& rule, const FileRules& file,
                                   Reporter& reporter) {
  MatchedAttributes matched;
  for (const Attribute& attribute : element.attributes()) {
    if (among(rule.foreign, attribute.name)) continue;
    const AttributeRule* meant = match(attribute, element, rule, file, reporter);
    if (meant != nullptr && !is_matched(matched, meant->name)) matched.emplace_back(meant->name, &attribute);
  }
  for (const AttributeRule& wanted : rule.attributes) {
    if (!wanted.required || is_matched(matched, wanted.name)) continue;
    reporter.error(file.codes.missing_attribute, element.position(),
                   tag(element.name()) + " needs the attribute " + in_quotes(wanted.name));
  }
  return matched;
}

const ElementRule* match_child(const Element& child, const ElementRule& parent, const FileRules& file,
                               Reporter& reporter) {
  if (const ElementRule* known = parent.child(child.name())) return known;
  if (file.find(child.name()) != nullptr) {
    report_misplaced(child, parent, file, reporter);
    return nullptr;
  }
  const ElementRule* meant = guess(child, parent);
  const auto near = meant == nullptr ? std::nullopt : std::optional(std::string(meant->name));
  reporter.error(file.codes.unknown_element, child.position(),
                 "there is no element " + tag(child.name()) + " in " + tag(parent.name) +
                     "; it may contain: " + listed(parent.child_names()) + did_you_mean(near));
  return meant;
}

void check_text(const Element& element, const FileRules& file, Reporter& reporter) {
  constexpr std::size_t kShown = 20;
  const std::string_view text = trimmed(element.text());
  if (text.empty()) return;
  const std::string shown = text.size() > kShown ? beginning_of(text, kShown) + "..." : std::string(text);
  const auto odd = odd_blank(text);  // invisible in quotes
  const std::string what = odd && odd->size == text.size() ? odd->name : "the text " + in_quotes(shown);
  reporter.error(file.codes.stray_text, element.text_position(),
                 what + " inside " + tag(element.name()) + " means nothing; " + std::string(file.title) +
                     " says everything in attributes");
}

}  // namespace orca::xml
