// SPDX-License-Identifier: LGPL-3.0-or-later
#include "orca/xml/schema.hpp"

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

#include "orca/xml/number.hpp"
#include "orca/xml/quantity.hpp"
#include "schema_model.hpp"

namespace orca::xml {
namespace {

using Form = ValueRule::Form;

// Returns "From 0 to 86400 s.", or nothing if everything is allowed.
std::string range_text(const ValueRule& rule) {
  if (rule.form != Form::number && rule.form != Form::integer) return {};
  const std::string unit = rule.unit.empty() ? "" : " " + std::string(rule.unit);
  std::string text;
  if (std::isfinite(rule.min))
    text = (rule.above_min ? "More than " : "From ") + number_text(rule.min) +
           (std::isfinite(rule.max) ? "" : unit);
  if (std::isfinite(rule.max)) text += (text.empty() ? "Up to " : " to ") + number_text(rule.max) + unit;
  if (text.empty() && !unit.empty()) text = "In" + unit;
  return text.empty() ? text : text + ".";
}

std::string with_range(std::string_view text, const ValueRule& rule) {
  const std::string range = range_text(rule);
  return std::string(text) + (text.empty() || range.empty() ? "" : " ") + range;
}

// Returns a unit as a part of a type's name: "m/s2" is "m_per_s2".
std::string name_part(std::string_view unit) {
  std::string name = unit.empty() ? "one" : std::string(unit);
  if (const auto slash = name.find('/'); slash != std::string::npos) name.replace(slash, 1, "_per_");
  return name;
}

// Returns a pattern of numbers with blanks between them, each with one of the unit's names or without.
std::string numbers_pattern(std::string_view si) {
  std::string units;
  for (const std::string_view unit : units_of(si)) units += (units.empty() ? "" : "|") + std::string(unit);
  const std::string number = "[+\\-]?([0-9]+\\.?[0-9]*|\\.[0-9]+)([eE][+\\-]?[0-9]+)?(\\s*(" + units + "))?";
  return "\\s*" + number + "(\\s+" + number + ")*\\s*";
}

std::string bound(double value) {
  if (!is_exact(value)) return "any";
  return (value < 0.0 ? "minus_" : "") + std::to_string(std::llabs(std::llround(value)));
}

// A maker of one schema. Its types are named after elements; the second rule of one name is named after its parent too.
class Maker {
 public:
  Maker(const FileRules& file, const SchemaOptions& options) : file_(file), options_(options) {}

  SchemaModel make() {
    std::set<const ElementRule*> inner;
    for (const ElementRule* rule : file_.elements)
      for (const ElementRule* child : rule->children) inner.insert(child);
    for (const ElementRule* rule : file_.elements)
      if (!inner.contains(rule)) model_.roots.push_back(child(*rule, ""));
    for (std::size_t next = 0; next < pending_.size(); ++next) {
      const Pending one = pending_[next];  // a copy, as others are added
      model_.types.push_back(type(one));
    }
    model_.has_arguments = options_.has_arguments;
    model_.others.assign(options_.others.begin(), options_.others.end());
    return std::move(model_);
  }

 private:
  struct Pending {
    const ElementRule* rule;
    std::string parent;
    std::string name;
  };

  [[nodiscard]] const Vocabulary* vocabulary(std::string_view element, std::string_view parent,
                                             std::string_view attribute) const {
    for (const Vocabulary& one : options_.vocabularies)
      if (one.element == element && (one.parent.empty() || one.parent == parent) &&
          one.attribute == attribute)
        return &one;
    return nullptr;
  }

  // Returns whether the element has words of its own within this parent.
  [[nodiscard]] bool is_special(const ElementRule& rule, std::string_view parent) const {
    return std::ranges::any_of(options_.vocabularies, [&](const Vocabulary& one) {
      return one.element == rule.name && !one.parent.empty() && one.parent == parent;
    });
  }

  // Returns the name of the element's type, which is written later.
  std::string type_of(const ElementRule& rule, const std::string& parent) {
    const std::string plain(rule.name);
    const bool is_taken = std::ranges::any_of(
        pending_, [&](const Pending& one) { return one.name == plain && one.rule != &rule; });
    std::string name = plain;
    if (is_special(rule, parent)) {
      name = plain + "_in_" + parent;
    } else if (is_taken) {
      const auto same = std::ranges::find(pending_, &rule, &Pending::rule);
      name = same == pending_.end() ? plain + "_in_" + parent : same->name;
    }
    if (std::ranges::find(pending_, name, &Pending::name) == pending_.end())
      pending_.push_back({&rule, parent, name});
    return name;
  }

  SchemaChild child(const ElementRule& rule, const std::string& parent) {
    SchemaChild made{.name = std::string(rule.name), .type = type_of(rule, parent)};
    for (const UniqueNames& one : options_.unique) {
      if (one.element != rule.name) continue;
      const std::string children(one.children);
      made.unique.emplace_back(
          "unique_" + children + "_in_" + made.name + (parent.empty() ? "" : "_of_" + parent), children);
    }
    return made;
  }

  SchemaType type(const Pending& one) {
    SchemaType made{.name = one.name, .text = std::string(one.rule->text)};
    for (const ElementRule* rule : one.rule->children)
      made.children.push_back(child(*rule, std::string(one.rule->name)));
    for (const AttributeRule& rule : one.rule->attributes) made.attributes.push_back(attribute(rule, one));
    for (const std::string_view name : one.rule->foreign)
      if (!name.starts_with("xmlns")) made.foreign.emplace_back(name);
    made.is_open = one.parent.empty() && !options_.others.empty();
    return made;
  }

  SchemaAttribute attribute(const AttributeRule& rule, const Pending& element) {
    const Vocabulary* words = vocabulary(element.rule->name, element.parent, rule.name);
    SchemaAttribute made{
        .name = std::string(rule.name), .required = rule.required, .text = with_range(rule.text, rule.value)};
    const std::string value = value_type(rule.value);
    if (words != nullptr) {
      made.words = words->words;
    } else {
      for (const std::string_view choice : rule.value.choices)
        made.words.push_back({std::string(choice), {}});
    }
    if (words != nullptr ? !words->only : rule.value.choices.empty())
      made.value = value;
    else if (options_.has_arguments)
      made.value = kArgument;
    return made;
  }

  // Returns the name of the type of values that follow a rule without choices.
  std::string value_type(const ValueRule& rule) {
    switch (rule.form) {
      case Form::text: return kAnyText;
      case Form::name: return value_type("name", {.pattern = "\\s*[A-Za-z][A-Za-z0-9_]{0,199}\\s*"});
      case Form::boolean: return value_type("boolean", {.pattern = "\\s*(true|false)\\s*"});
      case Form::integer:
        return value_type("whole_from_" + bound(rule.min) + "_to_" + bound(rule.max),
                          {.min = rule.min, .max = rule.max});
      case Form::number:
        return value_type("numbers_in_" + name_part(rule.unit), {.pattern = numbers_pattern(rule.unit)});
    }
    return kAnyText;
  }

  std::string value_type(const std::string& name, const SchemaValue& value) {
    model_.values.try_emplace(name, value);
    return name;
  }

  const FileRules& file_;
  const SchemaOptions& options_;
  std::vector<Pending> pending_;
  SchemaModel model_;
};

}  // namespace

bool is_exact(double value) { return std::fabs(value) < 9e15; }

SchemaModel schema_model(const FileRules& file, const SchemaOptions& options) {
  return Maker(file, options).make();
}

std::string schema(const FileRules& file, const SchemaOptions& options, SchemaLanguage language) {
  const SchemaModel model = schema_model(file, options);
  return language == SchemaLanguage::rnc ? rnc(model, options.title) : xsd(model, options.title);
}

}  // namespace orca::xml
