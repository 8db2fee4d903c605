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
constexpr std::array<std::string_view, 2> kRestore{"last", "none"};
constexpr std::array<std::string_view, 3> kStrategy{"one_for_one", "rest_for_one", "one_for_all"};
constexpr std::array<std::string_view, 1> kRecord{"always"};
constexpr std::array<std::string_view, 2> kSecurity{"on", "off"};
constexpr std::array<std::string_view, 2> kSupervisorLoss{"stop", "continue"};
constexpr std::array<std::string_view, 2> kMachineLoss{"stop", "go_on"};
constexpr std::array<std::string_view, 2> kExecutor{"thread", "fiber"};
constexpr std::array<std::string_view, 3> kRestart{"permanent", "transient", "temporary"};
constexpr std::array<std::string_view, 3> kLink{"local", "shm", "dds"};
constexpr std::array<std::string_view, 4> kOverflow{"drop_oldest", "drop_newest", "block", "refuse"};
constexpr std::array<std::string_view, 2> kConfirm{"accepted", "handled"};

constexpr double kDay = 86400.0;
constexpr double kMicrosecond = 1e-6;

constexpr ValueRule kBoolean{.form = ValueRule::Form::boolean, .choices = kYesNo};
constexpr ValueRule one_of(std::span<const std::string_view> choices) { return {.choices = choices}; }
constexpr ValueRule integer(double min, double max) {
  return {.form = ValueRule::Form::integer, .min = min, .max = max};
}
constexpr ValueRule seconds(double min, double max = kDay) {
  return {.form = ValueRule::Form::number, .unit = "s", .min = min, .max = max};
}
constexpr ValueRule bytes(double min, double max) {
  return {.form = ValueRule::Form::number, .unit = "B", .min = min, .max = max};
}

constexpr int kMostDomain = 232;  // beyond, the ports of DDS are no ports of UDP
constexpr std::array kGraph{
    AttributeRule{"name", true, "Name of the system."},
    AttributeRule{"version", false, "Version of the graph format; the only one is 1."},
    AttributeRule{"ends", false, "Components: the run ends when all of them are done or one has failed."},
    AttributeRule{"default_profile", false, "Profile that is chosen unless --profile names others."},
    AttributeRule{"plugins", false, "Further folders with plugins, separated by ';'."},
    AttributeRule{"strategy", false,
                  "What is started again when a process has failed: that one, also those after it, or all; "
                  "one_for_one if not given.",
                  one_of(kStrategy)},
    AttributeRule{"restarts", false,
                  "How often processes may be started again in the time of within; 3 if not given.",
                  integer(0, 1000)},
    AttributeRule{"within", false, "Time in which restarts are counted; 10 s if not given.", seconds(0.1)},
    AttributeRule{"on_supervisor_loss", false,
                  "What the processes do when their supervisor is gone; stop if not given.",
                  one_of(kSupervisorLoss)},
    AttributeRule{"adoption_wait", false,
                  "Longest time that they go on without one and wait for another; no limit if not given.",
                  seconds(0.1)},
    AttributeRule{"domain", false,
                  "DDS domain in which its processes and machines meet; 0 if not given. Systems of different "
                  "domains see nothing of each other.",
                  integer(0, kMostDomain)},
    AttributeRule{
        "join", false,
        "Team that the system joins, for example lab; none if not given. Its ports with team= speak to "
        "those of the other systems."},
    AttributeRule{"team_domain", false, "DDS domain in which the systems of the team meet; 0 if not given.",
                  integer(0, kMostDomain)},
    AttributeRule{"team_interface", false,
                  "Network interface on which they meet, for example wlan0; any if not given."},
    AttributeRule{"machine_wait", false,
                  "Longest time that a machine waits for the others at the start; 60 s if not given.",
                  seconds(0.1)},
    AttributeRule{"record", false,
                  "Whether a recording is always made of what runs in real time; none if not given.",
                  one_of(kRecord)},
    AttributeRule{"record_space", false,
                  "Most room for that recording on the disk, for example 2 GB; 500 MB if not given.",
                  bytes(20e6, 1e15)},
    AttributeRule{"security", false,
                  "Whether processes that speak over DDS prove by keys who they are, and encrypt; off if not "
                  "given.",
                  one_of(kSecurity)},
    AttributeRule{
        "expanded", false,
        "Whether the profiles and settings of a command line are merged into it already, as where Orca has "
        "printed it; then diff and apply do not merge them again.",
        kBoolean}};
constexpr std::array kMachine{
    AttributeRule{"name", true, "Name of the machine in this system."},
    AttributeRule{"address", false, "Its IP address or host name; found by itself if not given."},
    AttributeRule{"interface", false,
                  "Network interface of its links to other machines, for example wlan0; any if not given."},
    AttributeRule{"on_loss", false, "What the other machines do when this one goes away; stop if not given.",
                  one_of(kMachineLoss)},
    AttributeRule{"loss_limit", false,
                  "Time without a sign of life after which the others take it for gone; 1 s if not given.",
                  seconds(0.5)},
    AttributeRule{
        "delay", false,
        "Time that its link to other machines takes in virtual time, each way, for example 20 ms; 0 s if not "
        "given.",
        seconds(0.0)}};
constexpr std::array kProcess{
    AttributeRule{"name", true, "Name of the process."},
    AttributeRule{"machine", false, "Machine on which it runs; needed if the graph declares machines."},
    AttributeRule{"executor", false,
                  "How its components run: on a thread each, or all on one thread as fibers, which hand over "
                  "faster; thread if not given.",
                  one_of(kExecutor)},
    AttributeRule{
        "spin", false,
        "Longest time that an idle thread spins before it sleeps, for example 50 us; 0 s if not given.",
        seconds(0.0, 0.1)},
    AttributeRule{"processors", false,
                  "Numbers of the processors that it may use, counted from 0; all if not given."},
    AttributeRule{"cores", false,
                  "Number of laps with takes that compute at once in virtual time, the others wait; any "
                  "number if not given.",
                  integer(1, 1024)},
    AttributeRule{
        "delay", false,
        "Time that its connections to other processes take in virtual time, each way; 0 s if not given.",
        seconds(0.0)},
    AttributeRule{"priority", false, "Real-time priority from 1 to 99 (SCHED_FIFO); none if not given.",
                  integer(1, 99)},
    AttributeRule{"lock_memory", false, "Whether its memory always stays in RAM; false if not given.",
                  kBoolean},
    AttributeRule{"memory", false, "Most memory that it may have, for example 200 MB; no limit if not given.",
                  bytes(1e6, 1e15)},
    AttributeRule{"restart", false,
                  "When it is started again: whenever it has ended, only after a fault, or never; permanent "
                  "if not given.",
                  one_of(kRestart)},
    AttributeRule{"start", false,
                  "When it is started; on_demand: when a component of another process first uses one of its "
                  "components.",
                  one_of(kStart)},
    AttributeRule{"stay", false,
                  "Whether an on_demand process ends when nobody uses it any more (cold) or stays (warm).",
                  one_of(kStay)},
    AttributeRule{"idle_time", false,
                  "Time without use after which an on_demand process ends; 10 s if not given.", seconds(0.1)},
    AttributeRule{"hang_limit", false,
                  "Time without a sign of life after which it is killed; 0.5 s if not given.", seconds(0.01)},
    AttributeRule{"text", false, "Purpose of the process, for people."}};
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
    AttributeRule{"process", false, "Process in which the component runs; main if not given."},
    AttributeRule{"priority", false,
                  "From -100 to 100; of several components that are ready, the one with the highest priority "
                  "goes first.",
                  integer(-100, 100)},
    AttributeRule{"autonomous", false,
                  "Whether the component works without clients; without the attribute it decides itself.",
                  kBoolean},
    AttributeRule{
        "watchable", false,
        "Whether the component also works while somebody looks at what it pushes: orcactl, the page or a "
        "recording; without the attribute looking makes no component work.",
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
    AttributeRule{
        "takes", false,
        "Time that computing a lap takes in virtual time, for example 20 ms, or the file of a measurement "
        "from which it is drawn; 0 s if not given."},
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
    AttributeRule{
        "restore", false,
        "What it begins with after its process was lost: the last state that it has saved (last), or "
        "nothing (none); none if not given.",
        one_of(kRestore)},
    AttributeRule{"may_set", false,
                  "Parameters of other components that the component may set while it runs, for example "
                  "pilot.max_speed."},
    AttributeRule{"may_suspend", false,
                  "Other components that the component may suspend while it runs, for example walk."},
    AttributeRule{"may_fail", false,
                  "Whether a run may count as finished well although the component ends in WORK_FAILED.",
                  kBoolean}};
constexpr std::array kParam{
    AttributeRule{"name", true, ""},
    AttributeRule{"value", true, "Value with a unit (0.5 m, 22.5 deg); a bare number is in SI."}};
constexpr std::array kProperty{
    AttributeRule{"name", true, "Name of the property: letters, digits and '_'."},
    AttributeRule{"value", true,
                  "true, false, a number with its unit (0.1 m), or a text; a text that begins like one of "
                  "these is put between quotes."}};
constexpr std::array kConnect{
    AttributeRule{"from", false, "component.port: a PushServer, QueryProxy or SendProxy."},
    AttributeRule{"to", false, "component.port: a PushProxy, QueryServer or SendServer."},
    AttributeRule{"seek", false,
                  "Instead of the serving end, what its component must be like: terms such as "
                  "quality >= 0.5; platform == 'Dewey'."},
    AttributeRule{"prefer", false,
                  "Of the components that fit, which one is taken first: max or min and a property; in the "
                  "order of the file if not given."},
    AttributeRule{"choice", false,
                  "Rank of the connection, from 1, among several of one proxy, of which it uses one at a "
                  "time; seek gives it by itself.",
                  integer(1, 10'000)},
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
                  "Number of objects that may be dropped before it is logged, or any; default: any with "
                  "queue=\"latest\", otherwise 0.",
                  integer(0, 1'000'000'000)},
    AttributeRule{"interval", false, "Time in which at most one object is delivered, for example 1 s.",
                  seconds(0.0)},
    AttributeRule{
        "confirm", false,
        "Send: when an object counts as sent; as the receiver's port says if not given, as a rule accepted. "
        "accepted: it waits to be handled; handled: the receiver's handler has returned, and what it "
        "returned is the sender's answer.",
        one_of(kConfirm)},
    AttributeRule{"link", false,
                  "What carries the objects; if not given: local within a process, shm within a machine, dds "
                  "between machines.",
                  one_of(kLink)}};
constexpr std::array kGroup{
    AttributeRule{"name", true, "Name of the group; no component has the same."},
    AttributeRule{"components", true,
                  "Its components, of any processes; a component may be in several groups."}};
constexpr std::array kChange{
    AttributeRule{"at", true, "Time of the run at which it begins, counted as by --until, for example 20 s.",
                  seconds(0.0)},
    AttributeRule{"graph", true, "File of the other graph."}};
constexpr std::array kPort{
    AttributeRule{"name", true, "Name that the component's author gave the port."},
    AttributeRule{"as", false, "New name of the port, everywhere in this graph."},
    AttributeRule{"disabled", false, "Whether connections to the port are forbidden; optional ports only.",
                  kBoolean},
    AttributeRule{
        "candidates", false,
        "What a port array may be connected to at run time, by name: components, component.ports, or terms "
        "as in seek that the components meet."},
    AttributeRule{"topic", false, "Topic of ROS 2 on which the port speaks as well, for example /scan."},
    AttributeRule{"message", false,
                  "What is said on that topic, for example geometry_msgs/msg/TwistStamped; the usual message "
                  "for the port's type if not given."},
    AttributeRule{
        "team", false,
        "Name of what it offers to the team that the system joins, or hears from all others of it, for "
        "example pose; ports of Push only."}};
constexpr std::array kInclude{
    AttributeRule{"file", true, "Path of the graph file, relative to the folder of this file."}};
constexpr std::array kUse{
    AttributeRule{"graph", true, "Path of the graph file, relative to the folder of this file."},
    AttributeRule{"prefix", true, "Context that is put before the names of that graph."}};

constexpr std::array<std::string_view, 2> kEnds{"from", "to"};
// The attributes by which editors find graphs/orca-graph.xsd.
constexpr std::array<std::string_view, 2> kSchema{"xmlns:xsi", "xsi:noNamespaceSchemaLocation"};

constexpr ElementRule kArgRule{
    .name = "arg", .attributes = kArg, .text = "A value that can be set when the graph is run or included."};
constexpr ElementRule kGivenArgRule{
    .name = "arg", .attributes = kParam, .text = "Sets an argument of the file that is brought in."};
constexpr ElementRule kParamRule{.name = "param",
                                 .attributes = kParam,
                                 .text = "A parameter's value; deployer --describe PLUGIN.so lists them."};
constexpr ElementRule kPropertyRule{.name = "property",
                                    .attributes = kProperty,
                                    .text = "Something that the component exports about itself."};
constexpr ElementRule kPortRule{
    .name = "port", .attributes = kPort, .text = "A change to a port of the component, in this system only."};
constexpr ElementRule kConnectRule{
    .name = "connect", .attributes = kConnect, .text = "A connection between two ports.", .telling = kEnds};

constexpr ElementRule kGroupRule{
    .name = "group",
    .attributes = kGroup,
    .text = "Components that an operator suspends and resumes together, by one name."};

constexpr ElementRule kChangeRule{.name = "change",
                                  .attributes = kChange,
                                  .text = "Another graph that the run goes over to at a time known before."};

constexpr ElementRule kMachineRule{
    .name = "machine", .attributes = kMachine, .text = "A computer of the system."};
constexpr ElementRule kProcessRule{
    .name = "process", .attributes = kProcess, .text = "A process of the system, which components name."};

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

constexpr std::array kInProfile{&kMachineRule, &kProcessRule, &kHardwareRule, &kComponentRule, &kGroupRule,
                                &kConnectRule, &kChangeRule,  &kIncludeRule,  &kUseRule};
constexpr ElementRule kProfileRule{
    .name = "profile",
    .attributes = kProfile,
    .children = kInProfile,
    .text = "Parts that are added, or override others, when the profile is chosen."};

constexpr std::array kInGraph{&kArgRule,      &kProfileRule,   &kMachineRule, &kProcessRule,
                              &kHardwareRule, &kComponentRule, &kGroupRule,   &kConnectRule,
                              &kChangeRule,   &kIncludeRule,   &kUseRule};
constexpr ElementRule kGraphRule{.name = "graph",
                                 .attributes = kGraph,
                                 .children = kInGraph,
                                 .text = "A robot system.",
                                 .foreign = kSchema};

constexpr std::array kElements{&kGraphRule,    &kArgRule,       &kProfileRule, &kMachineRule,  &kProcessRule,
                               &kHardwareRule, &kComponentRule, &kParamRule,   &kPropertyRule, &kGroupRule,
                               &kConnectRule,  &kPortRule,      &kChangeRule,  &kIncludeRule,  &kUseRule};

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
