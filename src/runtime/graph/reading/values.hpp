// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <optional>
#include <string>

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

// Returns a path as the text means it: absolute and without "..". It starts at the folder of the file that
// names it, or at the current folder if the command line names it.
std::string resolved_path(const std::string& path, const Text& origin);

}  // namespace orca::graph
