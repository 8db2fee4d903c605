// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <optional>
#include <string>
#include <variant>

#include "node.hpp"
#include "orca/base/contract.hpp"
#include "orca/xml/rules.hpp"
#include "report.hpp"

namespace orca::graph {

// Returns the value of a text as the contract requires it: of its type, in SI, in range, files absolute.
// Returns nothing if the text is unknown or wrong; errors are reported after `title`.
std::optional<ParamValue> read_value(const Text& text, const ParamContract& contract,
                                     const std::string& title, Report& report);

// Returns the value of an attribute as its rule requires it: a boolean, an integer, a number in SI, a text.
std::optional<ParamValue> read_value(const Text& text, const xml::ValueRule& rule, const std::string& title,
                                     Report& report);

// Returns the value of a node's attribute as its rule requires it; nothing if it is not given, unknown or wrong.
// Errors are reported after the node's title and the attribute's name.
template <class T>
std::optional<T> read_attribute(const Node& node, const char* name, Report& report) {
  const Text* text = node.find(name);
  if (text == nullptr) return std::nullopt;
  const auto value = read_value(*text, node.rule->attribute(name)->value, node.title() + ": " + name, report);
  return value ? std::optional(std::get<T>(*value)) : std::nullopt;
}

// Returns a path as the text means it: absolute and without "..". It starts at the folder of the file that
// names it, or at the current folder if the command line names it.
std::string resolved_path(const std::string& path, const Text& origin);

// Reports a bad name of the node. Names that are missing or unknown are reported already.
void check_name(const Node& node, const char* attribute, Report& report);

}  // namespace orca::graph
