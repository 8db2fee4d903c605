// SPDX-License-Identifier: LGPL-3.0-or-later
#include "task_rules.hpp"

#include <algorithm>
#include <array>

namespace orca::tasks {
namespace {

using xml::AttributeRule;
using xml::ElementRule;
using xml::ValueRule;

constexpr double kLongest = 30.0 * 86400.0;  // [s]
constexpr ValueRule kText{};
constexpr ValueRule kTime{
    .form = ValueRule::Form::number, .unit = "s", .min = 0.0, .max = kLongest, .above_min = true};
constexpr ValueRule kTimes{.form = ValueRule::Form::integer, .min = 1, .max = 1e6};
constexpr ValueRule kVersion{.form = ValueRule::Form::integer, .min = 1, .max = 1};
constexpr std::array<std::string_view, 4> kWaysOn{"resume", "again", "done", "fail"};
constexpr std::array<std::string_view, 12> kReasons{"any",      "blocked",   "refused", "timed_out",
                                                    "lost",     "cancelled", "undone",  "unanswered",
                                                    "answered", "no_answer", "unmet",   "interrupted"};
constexpr ValueRule kThen{.choices = kWaysOn};
constexpr ValueRule kReason{.choices = kReasons};

constexpr std::array kTaskAttributes{
    AttributeRule{.name = "name", .required = true, .value = {.form = ValueRule::Form::name}},
    AttributeRule{.name = "version", .required = true, .value = kVersion},
    AttributeRule{.name = "text", .value = kText}};
constexpr std::array kNeed{AttributeRule{.name = "need", .value = kTimes}};
constexpr std::array kRepeat{AttributeRule{.name = "times", .value = kTimes},
                             AttributeRule{.name = "for", .value = kTime}};
constexpr std::array kRetry{AttributeRule{.name = "attempts", .required = true, .value = kTimes}};
constexpr std::array kTimeout{AttributeRule{.name = "after", .required = true, .value = kTime}};
constexpr std::array kWith{AttributeRule{.name = "set", .required = true, .value = kText},
                           AttributeRule{.name = "to", .required = true, .value = kText}};
constexpr std::array kSuspend{AttributeRule{.name = "component", .required = true, .value = kText}};
constexpr std::array kOn{AttributeRule{.name = "when", .required = true, .value = kText},
                         AttributeRule{.name = "then", .required = true, .value = kThen}};
constexpr std::array kCatch{AttributeRule{.name = "reason", .required = true, .value = kReason},
                            AttributeRule{.name = "then", .required = true, .value = kThen},
                            AttributeRule{.name = "times", .value = kTimes}};
constexpr std::array kDrive{AttributeRule{.name = "to", .required = true, .value = kText},
                            AttributeRule{.name = "within", .value = kTime}};
constexpr std::array kWait{AttributeRule{.name = "for", .required = true, .value = kTime}};
constexpr std::array kSay{AttributeRule{.name = "text", .required = true, .value = kText}};
constexpr std::array kAsk{AttributeRule{.name = "text", .required = true, .value = kText},
                          AttributeRule{.name = "within", .required = true, .value = kTime}};
constexpr std::array kCheck{AttributeRule{.name = "when", .required = true, .value = kText},
                            AttributeRule{.name = "within", .value = kTime}};

extern const ElementRule kSequenceRule, kFallbackRule, kParallelRule, kRepeatRule, kRetryRule, kTimeoutRule,
    kWithRule, kSuspendRule, kTryRule;

constexpr ElementRule kDriveRule{.name = "Drive", .attributes = kDrive};
constexpr ElementRule kWaitRule{.name = "Wait", .attributes = kWait};
constexpr ElementRule kSayRule{.name = "Say", .attributes = kSay};
constexpr ElementRule kAskRule{.name = "Ask", .attributes = kAsk};
constexpr ElementRule kCheckRule{.name = "Check", .attributes = kCheck};

constexpr std::array<const ElementRule*, 14> kSteps{
    &kSequenceRule, &kFallbackRule, &kParallelRule, &kRepeatRule, &kRetryRule, &kTimeoutRule, &kWithRule,
    &kSuspendRule,  &kTryRule,      &kDriveRule,    &kWaitRule,   &kSayRule,   &kAskRule,     &kCheckRule};

constexpr ElementRule kOnRule{.name = "On", .attributes = kOn, .children = kSteps};
constexpr ElementRule kCatchRule{.name = "Catch", .attributes = kCatch, .children = kSteps};

constexpr std::array<const ElementRule*, 16> kInTry{
    &kSequenceRule, &kFallbackRule, &kParallelRule, &kRepeatRule, &kRetryRule, &kTimeoutRule,
    &kWithRule,     &kSuspendRule,  &kTryRule,      &kDriveRule,  &kWaitRule,  &kSayRule,
    &kAskRule,      &kCheckRule,    &kOnRule,       &kCatchRule};

constinit const ElementRule kSequenceRule{.name = "Sequence", .children = kSteps};
constinit const ElementRule kFallbackRule{.name = "Fallback", .children = kSteps};
constinit const ElementRule kParallelRule{.name = "Parallel", .attributes = kNeed, .children = kSteps};
constinit const ElementRule kRepeatRule{.name = "Repeat", .attributes = kRepeat, .children = kSteps};
constinit const ElementRule kRetryRule{.name = "Retry", .attributes = kRetry, .children = kSteps};
constinit const ElementRule kTimeoutRule{.name = "Timeout", .attributes = kTimeout, .children = kSteps};
constinit const ElementRule kWithRule{.name = "With", .attributes = kWith, .children = kSteps};
constinit const ElementRule kSuspendRule{.name = "Suspend", .attributes = kSuspend, .children = kSteps};
constinit const ElementRule kTryRule{.name = "Try", .children = kInTry};

}  // namespace

constinit const ElementRule kTaskRule{.name = "task", .attributes = kTaskAttributes, .children = kSteps};

namespace {

constexpr std::array<const ElementRule*, 17> kElements{
    &kTaskRule,    &kSequenceRule, &kFallbackRule, &kParallelRule, &kRepeatRule, &kRetryRule,
    &kTimeoutRule, &kWithRule,     &kSuspendRule,  &kTryRule,      &kOnRule,     &kCatchRule,
    &kDriveRule,   &kWaitRule,     &kSayRule,      &kAskRule,      &kCheckRule};

struct NamedKind {
  std::string_view element;
  Kind kind;
};

constexpr std::array kKinds{NamedKind{"Sequence", Kind::sequence}, NamedKind{"Fallback", Kind::fallback},
                            NamedKind{"Parallel", Kind::parallel}, NamedKind{"Repeat", Kind::repeat},
                            NamedKind{"Retry", Kind::retry},       NamedKind{"Timeout", Kind::timeout},
                            NamedKind{"With", Kind::with},         NamedKind{"Suspend", Kind::suspend},
                            NamedKind{"Try", Kind::attempt},       NamedKind{"On", Kind::on},
                            NamedKind{"Catch", Kind::caught},      NamedKind{"Drive", Kind::drive},
                            NamedKind{"Wait", Kind::wait},         NamedKind{"Say", Kind::say},
                            NamedKind{"Ask", Kind::ask},           NamedKind{"Check", Kind::check}};

}  // namespace

const xml::FileRules kTaskFile{"a task",
                               kElements,
                               {.unknown_element = codes::kUnknownElement,
                                .misplaced_element = codes::kMisplacedElement,
                                .unknown_attribute = codes::kUnknownAttribute,
                                .missing_attribute = codes::kMissing,
                                .stray_text = codes::kStrayText,
                                .bad_value = codes::kBadValue}};

Kind kind_of(std::string_view element) {
  return std::ranges::find(kKinds, element, &NamedKind::element)->kind;
}

}  // namespace orca::tasks
