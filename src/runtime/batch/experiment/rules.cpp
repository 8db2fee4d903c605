// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rules.hpp"

#include <array>
#include <numbers>

namespace orca::batch {
namespace {

using xml::AttributeRule;
using xml::ElementRule;
using xml::ValueRule;

constexpr double kDay = 86400.0;
constexpr double kTurn = 2.0 * std::numbers::pi;  // [rad]
constexpr ValueRule kName{.form = ValueRule::Form::name};
constexpr ValueRule kSeconds{
    .form = ValueRule::Form::number, .unit = "s", .min = 0.0, .max = kDay, .above_min = true};
constexpr ValueRule kHold{.form = ValueRule::Form::number, .unit = "s", .min = 0.0, .max = kDay};
constexpr ValueRule kMetres{
    .form = ValueRule::Form::number, .unit = "m", .min = 0.0, .max = 1e6, .above_min = true};
constexpr ValueRule kCoordinate{.form = ValueRule::Form::number, .unit = "m", .min = -1e6, .max = 1e6};
constexpr ValueRule kAngle{.form = ValueRule::Form::number, .unit = "rad", .min = -kTurn, .max = kTurn};
constexpr ValueRule kTolerance{
    .form = ValueRule::Form::number, .unit = "rad", .min = 0.0, .max = 0.5 * kTurn, .above_min = true};
constexpr ValueRule kBytes{.form = ValueRule::Form::number, .unit = "B", .min = 1e8, .max = 1e15};

constexpr std::array<std::string_view, 2> kSubjects{"goals", "task"};
constexpr ValueRule kSubject{.choices = kSubjects};

constexpr std::array kExperiment{
    AttributeRule{"name", true, "Name of the experiment.", kName},
    AttributeRule{"version", false, "Version of the format; the only one is 1."},
    AttributeRule{"graph", false, "Graph of all variants that name none themselves."},
    AttributeRule{"profile", false,
                  "Profiles of the graph, as with deployer --profile, merged in this order; its "
                  "default_profile if not given."},
    AttributeRule{"seeds", true, "Seeds of the runs: numbers and ranges, \"1-20 50\"."},
    AttributeRule{"until", true, "Time after which a run ends, on its own clock.", kSeconds},
    AttributeRule{
        "claims", false,
        "What components' words are about: \"goals\", each of one of the goals in their order; or \"task\", "
        "which is done or has failed.",
        kSubject},
    AttributeRule{"metrics", false, "In which variants are compared; \"success time\" if not given."},
    AttributeRule{
        "computing", false,
        "How many times as long as the graphs say laps take: each variant is run with each of these "
        "factors, \"0 1 10\"; 1 if not given."},
    AttributeRule{"limit", false, "Time after which a run counts as hung; 300 s if not given.", kSeconds},
    AttributeRule{"memory", false, "Largest address space of a run; 8 GB if not given.", kBytes}};
constexpr std::array kSet{
    AttributeRule{"arg", true, "Argument of the graph, or COMPONENT.PARAM."},
    AttributeRule{"value", false, "Its value."},
    AttributeRule{"file", false, "Instead of value: a file, whose path starts at the experiment's folder."}};
constexpr std::array kGoal{
    AttributeRule{"robot", false, "Robot that has to get there; the only one if not given.", kName},
    AttributeRule{"place", false, "Place of the world, by its name, instead of x and y.", kName},
    AttributeRule{"x", false, "Place in the world frame.", kCoordinate},
    AttributeRule{"y", false, "Place in the world frame.", kCoordinate},
    AttributeRule{"radius", true, "Largest distance of the robot from there.", kMetres},
    AttributeRule{"heading", false, "Direction that the robot faces there; any if not given.", kAngle},
    AttributeRule{"heading_tolerance", false, "Largest difference from it; 20 deg if not given.", kTolerance},
    AttributeRule{"hold", false, "Time that it has to stay there; 0 if not given.", kHold}};
constexpr std::array<std::string_view, 4> kWaysToFail{"silent", "throw", "hang", "slow"};
constexpr std::array kFailing{
    AttributeRule{"component", true, "Component of the graph that fails.", kName},
    AttributeRule{"how", true, "As with deployer --fail.", {.choices = kWaysToFail}},
    AttributeRule{"at", true, "Time of the run at which it begins.", kHold},
    AttributeRule{"latest", false,
                  "If given, the time is drawn by the run's seed, and in each of `<worlds>` by its number, "
                  "too, from `at` up to this one.",
                  kSeconds}};
constexpr std::array kVariant{
    AttributeRule{"name", true, "Name of the variant.", kName},
    AttributeRule{"graph", false, "Its graph, if it is not that of all."},
    AttributeRule{"profile", false, "Its profiles, if they are not those of all."},
    AttributeRule{"settings", false,
                  "A file of settings for it, such as simbatch tune writes; its own "
                  "<set> have the last word."}};
constexpr std::array<std::string_view, 2> kScales{"linear", "log"};
constexpr std::array kTune{
    AttributeRule{"arg", true, "Argument of the graph, or COMPONENT.PARAM."},
    AttributeRule{"from", true, "Smallest value, with its unit."},
    AttributeRule{"to", true, "Largest value, of the same unit."},
    AttributeRule{
        "scale",
        false,
        "Whether equal differences or equal factors (log) are equally likely; \"linear\" if not given.",
        {.choices = kScales}}};
constexpr std::array kTuning{AttributeRule{"draws",
                                           true,
                                           "Draws of each variant; the first is what it is without any.",
                                           {.form = ValueRule::Form::integer, .min = 2, .max = 100'000}},
                             AttributeRule{"seed",
                                           false,
                                           "Seed of the draws; 1 if not given.",
                                           {.form = ValueRule::Form::integer, .min = 0, .max = 1e15}}};
constexpr std::array kSettingsFile{
    AttributeRule{"version", true, "Version of the format; the only one is 1."}};
constexpr std::array<std::string_view, 3> kClaims{"difference", "not_worse", "equal"};
constexpr std::array kContrast{
    AttributeRule{"first", true, "Name of a variant."},
    AttributeRule{"second", true, "Name of the variant that it is compared with."},
    AttributeRule{"metric", true, "In which they are compared."},
    AttributeRule{"claim", false, "What is to be shown; \"difference\" if not given.", {.choices = kClaims}},
    AttributeRule{"margin", false,
                  "Of not_worse and equal: a difference that would matter, in the metric's unit."}};
constexpr std::array kWorld{
    AttributeRule{"name", true, "Name of the world.", kName},
    AttributeRule{"reference", false, "Length of the way that runs are compared with.", kMetres},
    AttributeRule{"family", false, "Worlds of its kind; a family of its own if not given.", kName}};
constexpr std::array kWorlds{
    AttributeRule{"name", true, "Name of the family, before the number of each world: barn_17.", kName},
    AttributeRule{"arg", true, "Argument of the graph that gets FILE#NUMBER."},
    AttributeRule{"file", true, "File with numbered worlds, or a world with a <generate>."},
    AttributeRule{"numbers", false,
                  "Numbers and ranges, \"1-200\"; those of the table of references if not given."},
    AttributeRule{"references", false, "Table (.csv) with the length of the way of each number in a column."},
    AttributeRule{"column", false, "Name of that column; \"reference\" if not given."}};

}  // namespace

constexpr ElementRule kSetRule{
    .name = "set", .attributes = kSet, .text = "Something that is set in the graph."};

constexpr ElementRule kGoalRule{.name = "goal",
                                .attributes = kGoal,
                                .text = "Where a robot has to be, by its true pose, for the run to succeed."};

constexpr ElementRule kFailRule{
    .name = "fail", .attributes = kFailing, .text = "A failure of a component, on purpose."};

constexpr ElementRule kTuneRule{
    .name = "tune", .attributes = kTune, .text = "A setting that simbatch tune may choose from a range."};

namespace {

constexpr std::array kSettings{&kSetRule};
constexpr std::array kInVariant{&kSetRule, &kTuneRule};
constexpr std::array kInWorld{&kSetRule, &kGoalRule, &kFailRule};

}  // namespace

constexpr ElementRule kVariantRule{.name = "variant",
                                   .attributes = kVariant,
                                   .children = kInVariant,
                                   .text = "One of the things that are compared."};
constexpr ElementRule kSettingsFileRule{.name = "settings",
                                        .attributes = kSettingsFile,
                                        .children = kSettings,
                                        .text = "Settings of a variant, in a file of their own."};
constexpr ElementRule kWorldRule{.name = "world",
                                 .attributes = kWorld,
                                 .children = kInWorld,
                                 .text = "A place in which each variant is tried."};
constexpr ElementRule kWorldsRule{.name = "worlds",
                                  .attributes = kWorlds,
                                  .children = kInWorld,
                                  .text = "Many such places, by their numbers in a file."};

constexpr ElementRule kContrastRule{
    .name = "contrast", .attributes = kContrast, .text = "A question about two variants."};

namespace {

constexpr std::array kInTuning{&kWorldRule, &kWorldsRule};

}  // namespace

constexpr ElementRule kTuningRule{.name = "tuning",
                                  .attributes = kTuning,
                                  .children = kInTuning,
                                  .text = "The budget and the worlds of simbatch tune."};

namespace {

constexpr std::array kInExperiment{&kSetRule,    &kGoalRule,     &kVariantRule, &kWorldRule,
                                   &kWorldsRule, &kContrastRule, &kTuningRule};

}  // namespace

constexpr ElementRule kExperimentRule{.name = "experiment",
                                      .attributes = kExperiment,
                                      .children = kInExperiment,
                                      .text = "A comparison of variants in worlds."};

namespace {

constexpr std::array kElements{&kExperimentRule, &kSetRule,    &kGoalRule,        &kFailRule,
                               &kVariantRule,    &kWorldRule,  &kWorldsRule,      &kContrastRule,
                               &kTuneRule,       &kTuningRule, &kSettingsFileRule};

}  // namespace

constexpr xml::FileRules kExperimentFile{"an experiment",
                                         kElements,
                                         {.unknown_element = codes::kUnknownElement,
                                          .unknown_attribute = codes::kUnknownAttribute,
                                          .missing_attribute = codes::kMissing,
                                          .stray_text = codes::kStrayText,
                                          .bad_value = codes::kBadValue}};

}  // namespace orca::batch
