// SPDX-License-Identifier: LGPL-3.0-or-later
#include "orca/xml/rules.hpp"

#include <algorithm>

namespace orca::xml {
namespace {

const ElementRule* find_in(std::span<const ElementRule* const> rules, std::string_view name) {
  const auto found = std::ranges::find(rules, name, &ElementRule::name);
  return found == rules.end() ? nullptr : *found;
}

}  // namespace

const AttributeRule* ElementRule::attribute(std::string_view wanted) const {
  const auto found = std::ranges::find(attributes, wanted, &AttributeRule::name);
  return found == attributes.end() ? nullptr : &*found;
}

const ElementRule* ElementRule::child(std::string_view wanted) const { return find_in(children, wanted); }

std::vector<std::string> ElementRule::attribute_names() const {
  std::vector<std::string> names;
  for (const AttributeRule& rule : attributes) names.emplace_back(rule.name);
  return names;
}

std::vector<std::string> ElementRule::child_names() const {
  std::vector<std::string> names;
  for (const ElementRule* rule : children) names.emplace_back(rule->name);
  return names;
}

const ElementRule* FileRules::find(std::string_view element) const { return find_in(elements, element); }

std::string FileRules::parents_of(std::string_view child) const {
  std::string result;
  for (const ElementRule* rule : elements) {
    if (rule->child(child) == nullptr) continue;
    result += (result.empty() ? "<" : " or <") + std::string(rule->name) + ">";
  }
  return result;
}

}  // namespace orca::xml
