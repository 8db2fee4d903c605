// SPDX-License-Identifier: LGPL-3.0-or-later
#include "arguments.hpp"

#include <set>

#include "codes.hpp"
#include "naming.hpp"
#include "orca/base/text.hpp"
#include "orca/xml/names.hpp"

namespace orca::graph {
Arguments::Arguments(const CommandLine& line, Budget& budget, Report& report)
    : budget_(budget), report_(report), valueless_(line.valueless) {
  for (const auto& [name, value] : line.arguments) settings_[name] = {value, value.position};
}

Arguments::Arguments(const Node& bringer, Budget& budget, Report& report)
    : budget_(budget), report_(report), bringer_(&bringer) {
  for (const Node& arg : bringer.children) {
    const Text* name = arg.known("name");
    if (name == nullptr) continue;
    const Text* value = arg.find("value");  // a missing one is reported
    const Text unknown{"", arg.position, false, arg.position.file};
    settings_[name->value] = {value == nullptr ? unknown : *value, name->position};
  }
}

void Arguments::predefine(const std::string& name, const xml::Attribute& value) {
  const Text text{value.value, value.value_position, value.intact, value.value_position.file};
  arguments_[name] = {.value = text, .position = value.position, .used = true, .is_predefined = true};
}

void Arguments::declare(const Node& arg) {
  const Text* name = arg.known("name");
  if (name == nullptr) return;
  if (const auto fault = name_fault(name->value)) {
    report_.error(codes::kBadName, name->position, arg.title() + ": " + *fault);
  }
  const auto known = arguments_.find(name->value);
  if (known != arguments_.end() && !known->second.is_predefined) return report_duplicate(name->value, arg);
  arguments_[name->value] = read(name->value, arg);
  names_.push_back(name->value);
}

void Arguments::report_duplicate(const std::string& name, const Node& arg) {
  report_.error(codes::kDuplicateName, arg.place("name"),
                arg.title() + " is declared already at " + arguments_.at(name).position.text());
}

Arguments::Argument Arguments::read(const std::string& name, const Node& arg) {
  const auto setting = settings_.find(name);
  if (setting != settings_.end()) {
    setting->second.used = true;
    return {setting->second.value, arg.position};
  }
  if (const Text* default_value = arg.find("default")) return {*default_value, arg.position};
  return {{"", arg.position, false, arg.position.file}, arg.position, true};
}

void Arguments::report_without_value(const std::string& name, const Argument& argument) {
  const std::string title = "arg " + in_quotes(name);
  if (bringer_ == nullptr) {
    return report_.error(codes::kArgumentWithoutValue, argument.position,
                         title + " has no default and is not set: add --set " + name + "=VALUE");
  }
  report_.error(codes::kArgumentWithoutValue, bringer_->position,
                title + " of " + argument.position.file + " has no default and is not set: add <arg name=" +
                    in_quotes(name) + " value=\"...\"/> to this <" + std::string(bringer_->rule->name) + ">");
}

Text Arguments::replaced(const xml::Attribute& attribute) {
  Text text{"", attribute.value_position, attribute.intact, attribute.value_position.file};
  std::string_view rest = attribute.value;
  for (;;) {
    const std::size_t dollar = rest.find('$');
    text.value += rest.substr(0, dollar);
    if (dollar == std::string_view::npos) return text;
    rest.remove_prefix(dollar);
    replace_one(rest, text);
  }
}

void Arguments::replace_one(std::string_view& rest, Text& text) {
  if (rest.starts_with("$$")) {
    text.value += '$';
    return rest.remove_prefix(2);
  }
  const std::size_t end = rest.starts_with("${") ? rest.find('}') : std::string_view::npos;
  if (end == std::string_view::npos) {
    report_.error(codes::kBadDollar, text.position,
                  "a single '$' in " + in_quotes(rest) + "; write ${arg} for an argument, $$ for a dollar");
    text.known = false;
    return rest.remove_prefix(1);
  }
  append(std::string(rest.substr(2, end - 2)), text);
  rest.remove_prefix(end + 1);
}

void Arguments::append(const std::string& name, Text& text) {
  const auto found = arguments_.find(name);
  if (found == arguments_.end()) {
    text.known = false;
    return report_undefined(name, text);
  }
  Argument& argument = found->second;
  argument.used = true;
  if (text.value.empty()) text.named_in = argument.value.named_in;
  text.known = text.known && argument.value.known;
  if (budget_.take_characters(argument.value.value.size(), text.position, report_)) {
    text.value += argument.value.value;
  } else {
    text.known = false;
  }
}

void Arguments::report_undefined(const std::string& name, const Text& text) {
  const auto near = report_.nearest(name, names_);
  if (near) arguments_.at(*near).used = true;  // reporting it as unused would be a second error for one cause
  report_.error(
      codes::kUndefinedArgument, text.position,
      "${" + name + "} is not defined; there is <arg> for: " + listed(names_) + xml::did_you_mean(near));
}

std::optional<std::string> Arguments::report_no_such_argument(const std::string& name,
                                                              const Setting& setting) {
  const bool from_line = bringer_ == nullptr;
  const std::string what = from_line ? shown_setting(name) : "arg " + in_quotes(name);
  const std::string whose =
      from_line ? "the graph" : "the file that this <" + std::string(bringer_->rule->name) + "> names";
  const auto near = report_.nearest(name, names_);
  report_.error(
      codes::kBadSetting, setting.position,
      what + ": " + whose + " has no such argument; it has: " + listed(names_) + xml::did_you_mean(near));
  return near;
}

void Arguments::check_use() {
  std::set<std::string> meant =
      valueless_;  // reporting their missing value would be a second error for one cause
  for (const auto& [name, setting] : settings_)
    if (!setting.used)
      if (const auto argument = report_no_such_argument(name, setting)) meant.insert(*argument);
  for (const auto& [name, argument] : arguments_) {
    if (argument.without_value && !meant.contains(name)) report_without_value(name, argument);
    if (!argument.used) {
      report_.warning(codes::kUnusedArgument, argument.position,
                      "arg " + in_quotes(name) + " is used nowhere");
    }
  }
}

}  // namespace orca::graph
