// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rules.hpp"

#include <algorithm>
#include <array>

#include "orca/xml/names.hpp"

namespace orca::graph {
namespace {

using Support = ElementRule::Support;
using Attributes = std::span<const AttributeRule>;

constexpr std::array<std::string_view, 2> kYesNo{"true", "false"};
constexpr std::array<std::string_view, 2> kStart{"at_once", "on_demand"};
constexpr std::array<std::string_view, 2> kStay{"cold", "warm"};
constexpr std::array<std::string_view, 4> kOverflow{"drop_oldest", "drop_newest", "block", "refuse"};

constexpr std::array kGraph{
    AttributeRule{"name", true, "Name of the system."},
    AttributeRule{"version", false, "Of this format: 1."},
    AttributeRule{"ends", false, "Components: the run ends when they are done, or one of them has failed."},
    AttributeRule{"default_profile", false, "The profile that is taken unless --profile names others."},
    AttributeRule{"plugins", false, "More folders with plugins, separated by ';'."},
    AttributeRule{"seed", false, "Of all random numbers, unless --seed gives one."}};
constexpr std::array kArg{
    AttributeRule{"name", true, "Used as ${name} in the values of this file."},
    AttributeRule{"default", false, "Its value unless it is set; without one it must be set."},
    AttributeRule{"text", false, "What it is for."}};
constexpr std::array kProfile{AttributeRule{"name", true, "Profiles of one name in several files add up."}};
// The type may come from another profile, so it is looked for after merging.
constexpr std::array kHardware{AttributeRule{"name", true, "Name of the device in this system."},
                               AttributeRule{"type", false, "For example orca.hw.Sim."}};
constexpr std::array kComponent{
    AttributeRule{"name", true, "Letters, digits and '_'; contexts are joined by '/'."},
    AttributeRule{"type", false, "For example orca.SonarAvoid."},
    AttributeRule{"hardware", false, "The hardware that it wraps."},
    AttributeRule{"process", false, "The process that it lives in."},
    AttributeRule{"priority", false,
                  "-100 to 100: of components that are ready together the higher goes first."},
    AttributeRule{"autonomous", false, "Whether it works without clients.", kYesNo},
    AttributeRule{"period", false, "A lap each such time, for example 50 ms."},
    AttributeRule{"on", false, "A lap for each object that comes to this PushProxy."},
    AttributeRule{"start_after", false, "Components that must be up before."},
    AttributeRule{"start", false, "When its plugin is loaded: on_demand is when it is first asked for.",
                  kStart},
    AttributeRule{"stay", false, "Whether it stays loaded when nobody uses it any more.", kStay},
    AttributeRule{"idle_time", false, "So long unused it is unloaded."}};
constexpr std::array kParam{AttributeRule{"name", true, ""},
                            AttributeRule{"value", true, "With a unit (0.5 m, 22.5 deg), or bare in SI."}};
constexpr std::array kConnect{
    AttributeRule{"from", true, "component.port: a PushServer, QueryProxy or SendProxy."},
    AttributeRule{"to", true, "component.port: a PushProxy, QueryServer or SendServer."},
    AttributeRule{"queue", false, "How many objects wait: latest, or a number."},
    AttributeRule{"overflow", false, "What happens when the queue is full.", kOverflow},
    AttributeRule{"block_limit", false,
                  "So long at most the publisher waits for room, with overflow=\"block\"."},
    AttributeRule{"deadline", false, "Without an object for so long the edge counts a missed deadline."},
    AttributeRule{"interval", false, "Deliver at most one object in such a time, for example 1 s."}};
constexpr std::array kPort{
    AttributeRule{"name", true, "As its author calls it."},
    AttributeRule{"as", false, "As this graph calls it, everywhere."},
    AttributeRule{"disabled", false, "Whether nothing may be connected to it; optional ports only.", kYesNo},
    AttributeRule{
        "candidates", false,
        "Components or component.ports that a port array may be connected to at run time, by name."}};
constexpr std::array kInclude{AttributeRule{"file", true, "Path from the folder of this file."}};
constexpr std::array kUse{AttributeRule{"graph", true, "Path from the folder of this file."},
                          AttributeRule{"prefix", true, "The context that its names get here."}};

constexpr std::array<std::string_view, 9> kInGraph{"arg",     "profile", "hardware", "component", "connect",
                                                   "include", "use",     "machine",  "process"};
constexpr std::array<std::string_view, 7> kInProfile{"hardware", "component", "connect", "include",
                                                     "use",      "machine",   "process"};
constexpr std::array<std::string_view, 1> kInHardware{"param"};
constexpr std::array<std::string_view, 3> kInComponent{"param", "property", "port"};
constexpr std::array<std::string_view, 1> kInBringer{"arg"};

constexpr std::array kRules{
    ElementRule{"graph", kGraph, kInGraph, "A robot system."},
    ElementRule{"arg", kArg, {}, "A value that whoever starts or includes the graph may set."},
    ElementRule{"profile", kProfile, kInProfile,
                "Parts that are added or override others when it is chosen."},
    ElementRule{"hardware", kHardware, kInHardware, "A device, or the simulator in its place."},
    ElementRule{"component", kComponent, kInComponent, "One peer of the system."},
    ElementRule{"param", kParam, {}, "A parameter's value; deployer --describe PLUGIN.so lists them."},
    ElementRule{"property", kParam, {}, "Something that the component says of itself, to be found by."},
    ElementRule{"connect", kConnect, {}, "A connection between two ports."},
    ElementRule{"machine", Attributes{}, kInProfile, "", Support::transparent},
    ElementRule{"process", Attributes{}, kInProfile, "", Support::transparent},
    ElementRule{"port", kPort, {}, "What is different about a port of the component in this system."},
    ElementRule{"include", kInclude, kInBringer, "Another graph file, as if it stood here."},
    ElementRule{"use", kUse, kInBringer,
                "Another graph file as a sub-graph: its names get a context of their own."},
};
constexpr ElementRule kGivenArg{"arg", kParam, {}, "Sets an argument of the file that is brought in."};

}  // namespace

const AttributeRule* ElementRule::attribute(std::string_view wanted) const {
  const auto found = std::ranges::find(attributes, wanted, &AttributeRule::name);
  return found == attributes.end() ? nullptr : &*found;
}

bool ElementRule::allows(std::string_view child) const {
  return std::ranges::find(children, child) != children.end();
}

const ElementRule* ElementRule::child(std::string_view element) const {
  return brings_file(*this) ? &kGivenArg : find_rule(element);
}

const ElementRule* ElementRule::guess_child(const xml::Element& element) const {
  if (allows(element.name())) return child(element.name());
  if (find_rule(element.name()) != nullptr) return nullptr;
  if (const auto near = xml::nearest_name(element.name(), child_names())) return child(*near);
  const bool has_ends = element.attribute("from") != nullptr && element.attribute("to") != nullptr;
  return has_ends && allows("connect") ? find_rule("connect") : nullptr;
}

std::vector<std::string> ElementRule::attribute_names() const {
  std::vector<std::string> names;
  for (const AttributeRule& rule : attributes) names.emplace_back(rule.name);
  return names;
}

std::vector<std::string> ElementRule::child_names() const { return {children.begin(), children.end()}; }

bool brings_file(const ElementRule& rule) { return rule.name == "include" || rule.name == "use"; }

const char* file_attribute(const ElementRule& rule) { return rule.name == "use" ? "graph" : "file"; }

std::span<const ElementRule> all_rules() { return kRules; }

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
