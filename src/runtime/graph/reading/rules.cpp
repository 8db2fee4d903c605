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
constexpr std::array<std::string_view, 3> kFuse{"any", "all", "stamps"};
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
    AttributeRule{"version", false, "Version of the graph format; the only one is 1."},
    AttributeRule{"ends", false, "Components: the run ends when all of them are done or one has failed."},
    AttributeRule{"default_profile", false, "Profile that is chosen unless --profile names others."},
    AttributeRule{"plugins", false, "Further folders with plugins, separated by ';'."},
    AttributeRule{"seed", false, "Seed of all random numbers, unless --seed gives another.",
                  integer(0, ValueRule::kUnlimited)}};
constexpr std::array kArg{
    AttributeRule{"name", true, "Name of the argument; the values of this file use it as ${name}."},
    AttributeRule{"default", false,
                  "Value of the argument if it is not set; without a default it must be set."},
    AttributeRule{"text", false, "Purpose of the argument, for people."}};
constexpr std::array kProfile{
    AttributeRule{"name", true, "Name of the profile; profiles of the same name in several files add up."}};
// The type may come from another profile, so it is looked for after merging.
constexpr std::array kHardware{
    AttributeRule{"name", true, "Name of the device in this system."},
    AttributeRule{"type", false, "Type of the hardware, for example orca.hw.Sim."}};
constexpr std::array kComponent{
    AttributeRule{"name", true,
                  "Name of the component: letters, digits and '_'; contexts are joined by '/'."},
    AttributeRule{"type", false, "Type of the component, for example orca.SonarAvoid."},
    AttributeRule{"hardware", false, "Hardware that the component wraps."},
    AttributeRule{.name = "process",
                  .text = "all components live in one process until Orca can start several; remove it",
                  .planned = true},
    AttributeRule{"priority", false,
                  "From -100 to 100; of several components that are ready, the one with the highest priority "
                  "goes first.",
                  integer(-100, 100)},
    AttributeRule{"autonomous", false,
                  "Whether the component works without clients; without the attribute it decides itself.",
                  kBoolean},
    AttributeRule{"period", false, "Time from one lap to the next, for example 50 ms.",
                  seconds(kMicrosecond)},
    AttributeRule{"on", false, "PushProxies and port arrays whose new objects start the laps."},
    AttributeRule{
        "fuse", false,
        "With several ports in on: an object on any of them starts a lap, or new ones on all, or objects "
        "on all whose stamps say the same moment.",
        one_of(kFuse)},
    AttributeRule{"within", false,
                  "With fuse=\"stamps\": largest difference between stamps of one moment; 0 s if not given.",
                  seconds(0.0)},
    AttributeRule{"at_least_every", false,
                  "Longest time between two laps that objects start, for example 0.2 s.",
                  seconds(kMicrosecond)},
    AttributeRule{"start_after", false, "Components that must be up before this one."},
    AttributeRule{"start", false, "When the plugin is loaded; on_demand: when the component is first used.",
                  one_of(kStart)},
    AttributeRule{
        "stay", false,
        "Whether an on_demand component is unloaded when it is no longer used (cold) or stays (warm).",
        one_of(kStay)},
    AttributeRule{"idle_time", false,
                  "Time without use after which an on_demand component is unloaded; 10 s if not given.",
                  seconds(0.0)},
    AttributeRule{"may_fail", false,
                  "Whether a run may count as finished well although the component ends in WORK_FAILED.",
                  kBoolean}};
constexpr std::array kParam{
    AttributeRule{"name", true, ""},
    AttributeRule{"value", true, "Value with a unit (0.5 m, 22.5 deg); a bare number is in SI."}};
constexpr std::array kConnect{
    AttributeRule{"from", true, "component.port: a PushServer, QueryProxy or SendProxy."},
    AttributeRule{"to", true, "component.port: a PushProxy, QueryServer or SendServer."},
    AttributeRule{"queue", false, "Number of objects that can wait, or latest: only the newest waits.",
                  integer(1, 100'000)},
    AttributeRule{"overflow", false, "What happens when the queue is full.", one_of(kOverflow)},
    AttributeRule{"block_limit", false,
                  "Longest time that the publisher waits for room, with overflow=\"block\".",
                  seconds(kMicrosecond)},
    AttributeRule{"deadline", false,
                  "Time without an object after which the edge counts a missed deadline and logs it.",
                  seconds(0.0)},
    AttributeRule{"drop_limit", false,
                  "Number of objects that may be dropped before it is logged; default: any number with "
                  "queue=\"latest\", otherwise 0.",
                  integer(0, 1'000'000'000)},
    AttributeRule{"interval", false, "Time in which at most one object is delivered, for example 1 s.",
                  seconds(0.0)}};
constexpr std::array kPort{
    AttributeRule{"name", true, "Name that the component's author gave the port."},
    AttributeRule{"as", false, "New name of the port, everywhere in this graph."},
    AttributeRule{"disabled", false, "Whether connections to the port are forbidden; optional ports only.",
                  kBoolean},
    AttributeRule{
        "candidates", false,
        "Components or component.ports that a port array may be connected to at run time, by name."}};
constexpr std::array kInclude{
    AttributeRule{"file", true, "Path of the graph file, relative to the folder of this file."}};
constexpr std::array kUse{
    AttributeRule{"graph", true, "Path of the graph file, relative to the folder of this file."},
    AttributeRule{"prefix", true, "Context that is put before the names of that graph."}};

constexpr std::array<std::string_view, 2> kEnds{"from", "to"};
// The attributes by which editors find graphs/orca-graph.xsd.
constexpr std::array<std::string_view, 2> kSchema{"xmlns:xsi", "xsi:noNamespaceSchemaLocation"};

// These contain each other.
extern const ElementRule kMachineRule;
extern const ElementRule kProcessRule;

constexpr ElementRule kArgRule{
    .name = "arg", .attributes = kArg, .text = "A value that can be set when the graph is run or included."};
constexpr ElementRule kGivenArgRule{
    .name = "arg", .attributes = kParam, .text = "Sets an argument of the file that is brought in."};
constexpr ElementRule kParamRule{.name = "param",
                                 .attributes = kParam,
                                 .text = "A parameter's value; deployer --describe PLUGIN.so lists them."};
constexpr ElementRule kPropertyRule{
    .name = "property",
    .attributes = kParam,
    .text = "no component is found by its properties until there is a directory; remove it",
    .planned = true};
constexpr ElementRule kPortRule{
    .name = "port", .attributes = kPort, .text = "A change to a port of the component, in this system only."};
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
                                   .text = "Another graph file, read as if its elements stood here."};
constexpr ElementRule kUseRule{
    .name = "use",
    .attributes = kUse,
    .children = kInBringer,
    .text = "Another graph file as a sub-graph: its names get a context of their own."};

constexpr std::array kInProfile{&kHardwareRule, &kComponentRule, &kConnectRule, &kIncludeRule,
                                &kUseRule,      &kMachineRule,   &kProcessRule};
constexpr ElementRule kProfileRule{
    .name = "profile",
    .attributes = kProfile,
    .children = kInProfile,
    .text = "Parts that are added, or override others, when the profile is chosen."};
constexpr std::string_view kTakeOut = "put what it contains directly into the graph";
constexpr ElementRule kMachineRule{
    .name = "machine", .children = kInProfile, .text = kTakeOut, .planned = true};
constexpr ElementRule kProcessRule{
    .name = "process", .children = kInProfile, .text = kTakeOut, .planned = true};

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
