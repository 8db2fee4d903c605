// SPDX-License-Identifier: LGPL-3.0-or-later
#include "values.hpp"

#include <algorithm>
#include <filesystem>

#include "codes.hpp"
#include "naming.hpp"
#include "orca/base/input_file.hpp"
#include "orca/base/text.hpp"
#include "orca/xml/values.hpp"
#include "rules.hpp"

namespace orca::graph {
namespace {

xml::ValueRule rule_of(const ParamContract& contract, xml::ValueRule::Form form) {
  constexpr double kUnlimited = xml::ValueRule::kUnlimited;
  return {.form = form,
          .unit = contract.unit,
          .min = contract.min.value_or(-kUnlimited),
          .max = contract.max.value_or(kUnlimited)};
}

class Converter {
 public:
  Converter(const Text& text, const std::string& title, Report& report)
      : text_(text), title_(title), report_(report) {}

  std::optional<ParamValue> convert(const ParamContract& contract) {
    using Form = xml::ValueRule::Form;
    switch (contract.type) {
      case ParamType::boolean: return scalar(rule_of(contract, Form::boolean));
      case ParamType::integer: return scalar(rule_of(contract, Form::integer));
      case ParamType::real: return scalar(rule_of(contract, Form::number));
      case ParamType::text: return text(text_.value, contract);
      case ParamType::text_list: return list(contract);
    }
    return std::nullopt;
  }

  std::optional<ParamValue> convert(const xml::ValueRule& rule) {
    if (rule.form != xml::ValueRule::Form::text) return scalar(rule);
    const std::vector<std::string> choices(rule.choices.begin(), rule.choices.end());
    return one_of(text_.value, choices) ? std::optional<ParamValue>(text_.value) : std::nullopt;
  }

 private:
  std::optional<ParamValue> scalar(const xml::ValueRule& rule) {
    xml::ValueFault fault;
    if (rule.form == xml::ValueRule::Form::boolean) {
      if (const auto value = xml::read_boolean(text_.value, fault)) return *value;
    } else if (rule.form == xml::ValueRule::Form::integer) {
      if (const auto value = xml::read_integer(text_.value, rule, fault)) return *value;
    } else if (const auto value = xml::read_number(text_.value, rule, fault)) {
      return *value;
    }
    return wrong(xml::code_of(fault.kind, graph_rules().codes), fault.message);
  }

  bool one_of(const std::string& value, const std::vector<std::string>& choices) {
    if (choices.empty() || std::ranges::find(choices, value) != choices.end()) return true;
    wrong(codes::kChoice,
          in_quotes(value) + " is not one of: " + listed(choices) + report_.hint(value, choices));
    return false;
  }

  std::optional<ParamValue> text(const std::string& value, const ParamContract& contract) {
    if (!one_of(value, contract.choices)) return std::nullopt;
    if (!contract.file || value.empty()) return value;
    const std::string path = resolved_path(value, text_);
    remember_input_file(path);
    return path;
  }

  std::optional<ParamValue> list(const ParamContract& contract) {
    std::vector<std::string> result;
    for (const std::string& part : split_list(text_.value)) {
      if (part.empty()) {
        return wrong(codes::kBadValue,
                     in_quotes(text_.value) + " has an empty part; parts are separated by ';'");
      }
      const auto value = text(part, contract);
      if (!value) return std::nullopt;
      result.push_back(std::get<std::string>(*value));
    }
    return result;
  }

  std::nullopt_t wrong(const char* code, const std::string& message) {
    report_.error(code, text_.position, title_ + ": " + message);
    return std::nullopt;
  }

  const Text& text_;
  const std::string& title_;
  Report& report_;
};

}  // namespace

std::optional<ParamValue> read_value(const Text& text, const ParamContract& contract,
                                     const std::string& title, Report& report) {
  if (!text.known) return std::nullopt;
  return Converter(text, title, report).convert(contract);
}

std::optional<ParamValue> read_value(const Text& text, const xml::ValueRule& rule, const std::string& title,
                                     Report& report) {
  if (!text.known) return std::nullopt;
  return Converter(text, title, report).convert(rule);
}

std::string resolved_path(const std::string& path, const Text& origin) {
  namespace fs = std::filesystem;
  const fs::path folder = fs::path(origin.named_in).parent_path();
  std::error_code problem;
  const fs::path absolute = fs::absolute(folder / path, problem);
  return (problem ? folder / path : absolute).lexically_normal().string();
}

void check_name(const Node& node, const char* attribute, Report& report) {
  const Text* name = node.known(attribute);
  if (name == nullptr) return;
  const auto fault = name_fault(name->value);
  if (fault && !report.tolerates(name->value)) {
    report.error(codes::kBadName, name->position,
                 "the " + std::string(attribute) + " " + in_quotes(name->value) + " of a " +
                     std::string(node.rule->name) + ": " + *fault);
  }
}

}  // namespace orca::graph
