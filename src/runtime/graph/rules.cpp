// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rules.hpp"

#include <algorithm>
#include <array>

#include "orca/xml/names.hpp"

namespace orca::graph {
namespace {

using Support = ElementRule::Support;
using Attributes = std::span<const AttributeRule>;

constexpr std::array kGraph{AttributeRule{"name", true}, AttributeRule{"version"},
                            AttributeRule{"ends"},       AttributeRule{"default_profile"},
                            AttributeRule{"plugins"},    AttributeRule{"seed"}};
constexpr std::array kArg{AttributeRule{"name", true}, AttributeRule{"default"}, AttributeRule{"text"}};
constexpr std::array kNamed{AttributeRule{"name", true}};
// The type may come from another profile, so it is looked for after merging.
constexpr std::array kHardware{AttributeRule{"name", true}, AttributeRule{"type"}};
constexpr std::array kComponent{
    AttributeRule{"name", true}, AttributeRule{"type"},     AttributeRule{"hardware"},
    AttributeRule{"process"},    AttributeRule{"priority"}, AttributeRule{"autonomous"},
    AttributeRule{"period"},     AttributeRule{"on"},       AttributeRule{"start_after"},
    AttributeRule{"start"},      AttributeRule{"stay"},     AttributeRule{"idle_time"}};
constexpr std::array kParam{AttributeRule{"name", true}, AttributeRule{"value", true}};
constexpr std::array kConnect{AttributeRule{"from", true}, AttributeRule{"to", true}, AttributeRule{"queue"},
                              AttributeRule{"overflow"}, AttributeRule{"interval"}};

constexpr std::array<std::string_view, 9> kInGraph{"arg",     "profile", "hardware", "component", "connect",
                                                   "include", "use",     "machine",  "process"};
constexpr std::array<std::string_view, 7> kInProfile{"hardware", "component", "connect", "include",
                                                     "use",      "machine",   "process"};
constexpr std::array<std::string_view, 1> kInHardware{"param"};
constexpr std::array<std::string_view, 2> kInComponent{"param", "property"};

constexpr std::array kRules{
    ElementRule{"graph", kGraph, kInGraph},
    ElementRule{"arg", kArg, {}},
    ElementRule{"profile", kNamed, kInProfile},
    ElementRule{"hardware", kHardware, kInHardware},
    ElementRule{"component", kComponent, kInComponent},
    ElementRule{"param", kParam, {}},
    ElementRule{"property", kParam, {}},
    ElementRule{"connect", kConnect, {}},
    ElementRule{"machine", Attributes{}, kInProfile, Support::transparent},
    ElementRule{"process", Attributes{}, kInProfile, Support::transparent},
    ElementRule{"include", Attributes{}, {}, Support::none},
    ElementRule{"use", Attributes{}, {}, Support::none},
};

}  // namespace

const AttributeRule* ElementRule::attribute(std::string_view wanted) const {
  const auto found = std::ranges::find(attributes, wanted, &AttributeRule::name);
  return found == attributes.end() ? nullptr : &*found;
}

bool ElementRule::allows(std::string_view child) const {
  return std::ranges::find(children, child) != children.end();
}

const ElementRule* ElementRule::guess_child(const xml::Element& element) const {
  if (allows(element.name())) return find_rule(element.name());
  if (find_rule(element.name()) != nullptr) return nullptr;
  if (const auto near = xml::nearest_name(element.name(), child_names())) return find_rule(*near);
  const bool has_ends = element.attribute("from") != nullptr && element.attribute("to") != nullptr;
  return has_ends && allows("connect") ? find_rule("connect") : nullptr;
}

std::vector<std::string> ElementRule::attribute_names() const {
  std::vector<std::string> names;
  for (const AttributeRule& rule : attributes) names.emplace_back(rule.name);
  return names;
}

std::vector<std::string> ElementRule::child_names() const { return {children.begin(), children.end()}; }

const ElementRule* find_rule(std::string_view element) {
  const auto found = std::ranges::find(kRules, element, &ElementRule::name);
  return found == kRules.end() ? nullptr : &*found;
}

std::string parents_of(std::string_view child) {
  std::string result;
  for (const ElementRule& rule : kRules) {
    if (!rule.allows(child) || rule.support != Support::full) continue;
    result += (result.empty() ? "<" : " or <") + std::string(rule.name) + ">";
  }
  return result;
}

}  // namespace orca::graph
