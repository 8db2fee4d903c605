// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rules.hpp"

#include <array>

#include "codes.hpp"

namespace orca::graph {
namespace {

using xml::AttributeRule;
using xml::ElementRule;
using xml::ValueRule;

constexpr std::array<std::string_view, 2> kYesNo{"true", "false"};
constexpr std::array<std::string_view, 2> kStart{"at_once", "on_demand"};
constexpr std::array<std::string_view, 2> kFuse{"any", "all"};
constexpr std::array<std::string_view, 2> kStay{"cold", "warm"};
constexpr std::array<std::string_view, 4> kOverflow{"drop_oldest", "drop_newest", "block", "refuse"};

constexpr double kDay = 86400.0;
constexpr double kMicrosecond = 1e-6;

constexpr ValueRule kBoolean{.form = ValueRule::Form::boolean, .choices = kYesNo};
constexpr ValueRule one_of(std::span<const std::string_view> choices) { return {.choices = choices}; }
constexpr ValueRule integer(double min, double max) {
  return {.form = ValueRule::Form::integer, .min = min, .max = max};
}
constexpr ValueRule seconds(double min) {
  return {.form = ValueRule::Form::number, .unit = "s", .min = min, .max = kDay};
}

constexpr std::array kGraph{
    AttributeRule{"name", true, "Name of the system."},
    AttributeRule{"version", false, "Of this format: 1."},
    AttributeRule{"ends", false, "Components: the run ends when they are done, or one of them has failed."},
    AttributeRule{"default_profile", false, "The profile that is taken unless --profile names others."},
    AttributeRule{"plugins", false, "More folders with plugins, separated by ';'."},
    AttributeRule{"seed", false, "Of all random numbers, unless --seed gives one.",
                  integer(0, ValueRule::kUnlimited)}};
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
                  "-100 to 100: of components that are ready together the higher goes first.",
                  integer(-100, 100)},
    AttributeRule{"autonomous", false, "Whether it works without clients.", kBoolean},
    AttributeRule{"period", false, "A lap each such time, for example 50 ms.", seconds(kMicrosecond)},
    AttributeRule{"on", false, "PushProxies whose new objects start the laps."},
    AttributeRule{
        "fuse", false,
        "With several ports in on: whether an object on any of them starts a lap, or new ones on all.",
        one_of(kFuse)},
    AttributeRule{"at_least_every", false, "With on: longest time between two laps, for example 0.2 s.",
                  seconds(kMicrosecond)},
    AttributeRule{"start_after", false, "Components that must be up before."},
    AttributeRule{"start", false, "When its plugin is loaded: on_demand is when it is first asked for.",
                  one_of(kStart)},
    AttributeRule{"stay", false, "Whether it stays loaded when nobody uses it any more.", one_of(kStay)},
    AttributeRule{"idle_time", false, "So long unused it is unloaded.", seconds(0.0)}};
constexpr std::array kParam{AttributeRule{"name", true, ""},
                            AttributeRule{"value", true, "With a unit (0.5 m, 22.5 deg), or bare in SI."}};
constexpr std::array kConnect{
    AttributeRule{"from", true, "component.port: a PushServer, QueryProxy or SendProxy."},
    AttributeRule{"to", true, "component.port: a PushProxy, QueryServer or SendServer."},
    AttributeRule{"queue", false, "How many objects wait: latest, or a number.", integer(1, 100'000)},
    AttributeRule{"overflow", false, "What happens when the queue is full.", one_of(kOverflow)},
    AttributeRule{"block_limit", false,
                  "So long at most the publisher waits for room, with overflow=\"block\".",
                  seconds(kMicrosecond)},
    AttributeRule{"deadline", false, "Without an object for so long the edge counts a missed deadline.",
                  seconds(0.0)},
    AttributeRule{"interval", false, "Deliver at most one object in such a time, for example 1 s.",
                  seconds(0.0)}};
constexpr std::array kPort{
    AttributeRule{"name", true, "As its author calls it."},
    AttributeRule{"as", false, "As this graph calls it, everywhere."},
    AttributeRule{"disabled", false, "Whether nothing may be connected to it; optional ports only.",
                  kBoolean},
    AttributeRule{
        "candidates", false,
        "Components or component.ports that a port array may be connected to at run time, by name."}};
constexpr std::array kInclude{AttributeRule{"file", true, "Path from the folder of this file."}};
constexpr std::array kUse{AttributeRule{"graph", true, "Path from the folder of this file."},
                          AttributeRule{"prefix", true, "The context that its names get here."}};

constexpr std::array<std::string_view, 2> kEnds{"from", "to"};
// The attributes by which editors find graphs/orca-graph.xsd.
constexpr std::array<std::string_view, 2> kSchema{"xmlns:xsi", "xsi:noNamespaceSchemaLocation"};

// These contain each other.
extern const ElementRule kMachineRule;
extern const ElementRule kProcessRule;

constexpr ElementRule kArgRule{
    .name = "arg", .attributes = kArg, .text = "A value that whoever starts or includes the graph may set."};
constexpr ElementRule kGivenArgRule{
    .name = "arg", .attributes = kParam, .text = "Sets an argument of the file that is brought in."};
constexpr ElementRule kParamRule{.name = "param",
                                 .attributes = kParam,
                                 .text = "A parameter's value; deployer --describe PLUGIN.so lists them."};
constexpr ElementRule kPropertyRule{.name = "property",
                                    .attributes = kParam,
                                    .text = "Something that the component says of itself, to be found by."};
constexpr ElementRule kPortRule{.name = "port",
                                .attributes = kPort,
                                .text = "What is different about a port of the component in this system."};
constexpr ElementRule kConnectRule{
    .name = "connect", .attributes = kConnect, .text = "A connection between two ports.", .telling = kEnds};

constexpr std::array kInHardware{&kParamRule};
constexpr ElementRule kHardwareRule{.name = "hardware",
                                    .attributes = kHardware,
                                    .children = kInHardware,
                                    .text = "A device, or the simulator in its place."};
constexpr std::array kInComponent{&kParamRule, &kPropertyRule, &kPortRule};
constexpr ElementRule kComponentRule{.name = "component",
                                     .attributes = kComponent,
                                     .children = kInComponent,
                                     .text = "One peer of the system."};
constexpr std::array kInBringer{&kGivenArgRule};
constexpr ElementRule kIncludeRule{.name = "include",
                                   .attributes = kInclude,
                                   .children = kInBringer,
                                   .text = "Another graph file, as if it stood here."};
constexpr ElementRule kUseRule{
    .name = "use",
    .attributes = kUse,
    .children = kInBringer,
    .text = "Another graph file as a sub-graph: its names get a context of their own."};

constexpr std::array kInProfile{&kHardwareRule, &kComponentRule, &kConnectRule, &kIncludeRule,
                                &kUseRule,      &kMachineRule,   &kProcessRule};
constexpr ElementRule kProfileRule{.name = "profile",
                                   .attributes = kProfile,
                                   .children = kInProfile,
                                   .text = "Parts that are added or override others when it is chosen."};
constexpr ElementRule kMachineRule{.name = "machine", .children = kInProfile, .planned = true};
constexpr ElementRule kProcessRule{.name = "process", .children = kInProfile, .planned = true};

constexpr std::array kInGraph{&kArgRule,     &kProfileRule, &kHardwareRule, &kComponentRule, &kConnectRule,
                              &kIncludeRule, &kUseRule,     &kMachineRule,  &kProcessRule};
constexpr ElementRule kGraphRule{.name = "graph",
                                 .attributes = kGraph,
                                 .children = kInGraph,
                                 .text = "A robot system.",
                                 .foreign = kSchema};

constexpr std::array kElements{&kGraphRule, &kArgRule,      &kProfileRule, &kHardwareRule, &kComponentRule,
                               &kParamRule, &kPropertyRule, &kConnectRule, &kMachineRule,  &kProcessRule,
                               &kPortRule,  &kIncludeRule,  &kUseRule};

constexpr xml::FileRules kFile{"a graph",
                               kElements,
                               {.unknown_element = codes::kUnknownElement,
                                .misplaced_element = codes::kMisplacedElement,
                                .unknown_attribute = codes::kUnknownAttribute,
                                .missing_attribute = codes::kMissingAttribute,
                                .stray_text = codes::kStrayText,
                                .bad_value = codes::kBadValue,
                                .wrong_unit = codes::kUnit,
                                .out_of_range = codes::kRange,
                                .unknown_choice = codes::kChoice}};

}  // namespace

const xml::FileRules& graph_rules() { return kFile; }

bool brings_file(const ElementRule& rule) { return rule.name == "include" || rule.name == "use"; }

const char* file_attribute(const ElementRule& rule) { return rule.name == "use" ? "graph" : "file"; }

}  // namespace orca::graph
