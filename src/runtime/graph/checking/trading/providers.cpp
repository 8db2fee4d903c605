// SPDX-License-Identifier: LGPL-3.0-or-later
#include "providers.hpp"

#include <algorithm>
#include <set>
#include <utility>

#include "checking/endpoints.hpp"
#include "orca/base/text.hpp"
#include "orca/xml/names.hpp"
#include "reading/codes.hpp"
#include "reading/trading/constraint.hpp"
#include "reading/trading/properties.hpp"

namespace orca::graph {
namespace {

constexpr std::size_t kMostMisses = 10;  // that a message names

bool replies_fit(const PortContract& a, const PortContract& b) {
  if (!a.reply || !b.reply) return !a.reply && !b.reply;
  return a.role == Role::server ? is_a(*a.reply, *b.reply) : is_a(*b.reply, *a.reply);
}

// A component of the graph, as those who seek it see it.
class Offer {
 public:
  Offer(const CheckedComponent& component, const std::string& context, const Model& model)
      : component_(component), properties_(component.value.properties) {
    const auto within = [&](const std::string& name) {
      return name.starts_with(context) ? name.substr(context.size()) : name;
    };
    const ComponentNode& node = component.value;
    properties_["type"] = node.type;
    properties_["name"] = within(node.name);
    properties_["process"] = within(node.process);
    const CheckedProcess* const process = model.find_process(node.process);
    if (process != nullptr && !process->value.machine.empty())
      properties_["machine"] = within(process->value.machine);
  }

  [[nodiscard]] const std::string& name() const { return component_.value.name; }
  [[nodiscard]] const Properties& properties() const { return properties_; }

  [[nodiscard]] const PropertyValue* property(const std::string& wanted) const {
    const auto found = properties_.find(wanted);
    return found == properties_.end() ? nullptr : &found->second;
  }

  // Returns the ports that can serve the wish.
  [[nodiscard]] std::vector<std::string> fitting_ports(const Wish& wish) const {
    std::vector<std::string> fitting;
    for (const PortContract& port : component_.contract->ports)
      if (fit_together(port, wish.wanted) && replies_fit(port, wish.wanted))
        fitting.push_back(name() + "." + port.name);
    return fitting;
  }

 private:
  const CheckedComponent& component_;
  Properties properties_;
};

// What a component lacks: "its accuracy is 0.5 m". Empty: nothing.
struct Judgement {
  std::vector<std::string> lacks;
  std::vector<std::string> incomparable;
};

Judgement judge(const Offer& offer, const Constraint& constraint) {
  Judgement judgement;
  for (const Term& term : constraint) {
    const PropertyValue* const property = offer.property(term.name);
    if (property == nullptr) {
      judgement.lacks.push_back("it has no " + term.name);
      continue;
    }
    const std::string found = "its " + term.name + " is " + constraint_text(*property);
    const TermOutcome outcome = evaluate(term, *property);
    if (outcome == TermOutcome::misses) judgement.lacks.push_back(found);
    if (outcome == TermOutcome::incomparable)
      judgement.incomparable.push_back(found + ", which cannot be compared with " +
                                       constraint_text(term.value));
  }
  return judgement;
}

class Search {
 public:
  Search(const Wish& wish, const Model& model, Report& report)
      : wish_(wish), model_(model), report_(report), title_(in_quotes(wish.client.text())) {
    for (const CheckedComponent& component : model.components) {
      if (component.duplicate || !component.value.name.starts_with(wish.context)) continue;
      is_complete_ = is_complete_ && component.contract && component.ports_known;
      if (component.contract && component.ports_known) offers_.emplace_back(component, wish.context, model);
    }
  }

  std::optional<std::vector<std::string>> run() {
    if (!read()) return std::nullopt;
    for (const Offer& offer : offers_) consider(offer);
    if (has_failed_) return std::nullopt;
    if (found_.empty() && is_complete_ && !model_.parts_missing) refuse_nothing();
    if (found_.empty()) return std::nullopt;
    if (preference_ && !sort()) return std::nullopt;
    std::vector<std::string> ports;
    for (const auto& [offer, port] : found_) ports.push_back(port);
    return ports;
  }

 private:
  bool read() {
    ConstraintFault fault;
    const auto constraint = parse_constraint(wish_.constraint.value, fault);
    if (constraint)
      constraint_ = *constraint;
    else
      refuse_text(wish_.constraint, wish_.attribute, fault);
    if (wish_.prefer != nullptr) {
      preference_ = parse_preference(wish_.prefer->value, fault);
      if (!preference_) refuse_text(*wish_.prefer, "prefer", fault);
    }
    if (has_failed_) return false;
    for (const Term& term : constraint_) check_known(term.name, wish_.constraint.position);
    if (preference_) check_known(preference_->name, wish_.prefer->position);
    return !has_failed_;
  }

  void refuse_text(const Text& text, const char* attribute, const ConstraintFault& fault) {
    refuse(codes::kConstraint, text.position,
           std::string(attribute) + " of " + title_ + ", column " + std::to_string(fault.column) + " of " +
               in_quotes(text.value) + ": " + fault.message);
  }

  // A name that no component has is probably misspelt.
  void check_known(const std::string& name, const xml::Position& place) {
    std::set<std::string> known(kImplicitProperties.begin(), kImplicitProperties.end());
    for (const Offer& offer : offers_)
      for (const auto& [property, value] : offer.properties()) known.insert(property);
    if (known.contains(name)) return;
    has_failed_ = true;
    const std::vector<std::string> names(known.begin(), known.end());
    const std::string hint = report_.hint(name, names);
    if ((!is_complete_ || model_.parts_missing || model_.names_incomplete) && hint.empty()) return;
    report_.error(codes::kUnknownProperty, place,
                  title_ + " seeks a component by its " + in_quotes(name) +
                      ", which no component has; they have: " + listed(names) + hint);
  }

  void consider(const Offer& offer) {
    const std::vector<std::string> ports = offer.fitting_ports(wish_);
    const Judgement judgement = judge(offer, constraint_);
    if (ports.empty()) {
      if (judgement.lacks.empty() && judgement.incomparable.empty())
        note_miss(offer, "it has no port that fits");
      return;
    }
    if (!judgement.incomparable.empty() && !std::exchange(is_incomparable_, true))
      return refuse(codes::kTrade, wish_.constraint.position,
                    title_ + " seeks " + in_quotes(wish_.constraint.value) + ", and for " +
                        in_quotes(offer.name()) + ": " + listed(judgement.incomparable));
    if (!judgement.lacks.empty()) return note_miss(offer, joined(judgement.lacks, ", "));
    take(offer, ports);
  }

  void take(const Offer& offer, const std::vector<std::string>& ports) {
    if (offer.name() == wish_.client.component)
      return refuse(codes::kTrade, wish_.constraint.position,
                    title_ + " seeks " + in_quotes(wish_.constraint.value) +
                        ", and its own component fits; exclude it, for example with name != '" +
                        offer.name().substr(wish_.context.size()) + "'");
    if (ports.size() > 1)
      return refuse(codes::kTrade, wish_.constraint.position,
                    title_ + " seeks a port of " + in_quotes(offer.name()) +
                        ", and several fit: " + listed(ports) + "; " +
                        (std::string_view(wish_.attribute) == "seek" ? "connect one of them by its name"
                                                                     : "name the candidates"));
    found_.emplace_back(&offer, ports.front());
  }

  void note_miss(const Offer& offer, const std::string& why) {
    misses_.push_back(in_quotes(offer.name()) + ": " + why);
  }

  void refuse_nothing() {
    refuse(codes::kNothingFits, wish_.constraint.position,
           title_ + " (" + described(wish_.wanted) + ") seeks " + in_quotes(wish_.constraint.value) +
               ", and nothing fits; " +
               (misses_.empty() ? "no component has a port that fits" : "nearly: " + nearly()));
  }

  [[nodiscard]] std::string nearly() const {
    const std::size_t shown = std::min(misses_.size(), kMostMisses);
    const std::string text = joined(std::span(misses_).first(shown), "; ");
    return shown == misses_.size() ? text
                                   : text + "; and " + std::to_string(misses_.size() - shown) + " more";
  }

  // Sorts by the preferred property; components without it come last. Returns false after a report.
  bool sort() {
    for (const auto& [offer, port] : found_) check_preferred(*offer);
    if (has_failed_) return false;
    const auto rank = [&](const auto& found) {
      const PropertyValue* const value = found.first->property(preference_->name);
      return value == nullptr ? std::nullopt : std::optional(std::get<Quantity>(*value).value);
    };
    std::ranges::stable_sort(found_, [&](const auto& a, const auto& b) {
      const auto first = rank(a);
      const auto second = rank(b);
      if (!first || !second) return first.has_value() && !second.has_value();
      return preference_->largest ? *first > *second : *first < *second;
    });
    return true;
  }

  void check_preferred(const Offer& offer) {
    const PropertyValue* const value = offer.property(preference_->name);
    if (value == nullptr) return;
    const auto* const number = std::get_if<Quantity>(value);
    const bool fits = number != nullptr && are_comparable(*number, unit_);
    if (fits && unit_.unit.empty()) unit_ = *number;
    if (!fits)
      refuse(codes::kTrade, wish_.prefer->position,
             title_ + " prefers by " + in_quotes(preference_->name) + ", which is " +
                 constraint_text(*value) + " for " + in_quotes(offer.name()) +
                 "; numbers of one unit are needed");
  }

  void refuse(const char* code, const xml::Position& place, const std::string& message) {
    report_.error(code, place, message);
    has_failed_ = true;
  }

  const Wish& wish_;
  const Model& model_;
  Report& report_;
  const std::string title_;
  std::vector<Offer> offers_;
  bool is_complete_ = true;  // whether the ports of all components are known
  Constraint constraint_;
  std::optional<Preference> preference_;
  Quantity unit_;  // of the preferred property, as far as it is known
  std::vector<std::pair<const Offer*, std::string>> found_;
  std::vector<std::string> misses_;
  bool is_incomparable_ = false;  // a term and a property, which is reported
  bool has_failed_ = false;
};

}  // namespace

std::optional<std::vector<std::string>> find_providers(const Wish& wish, const Model& model, Report& report) {
  return Search(wish, model, report).run();
}

}  // namespace orca::graph
