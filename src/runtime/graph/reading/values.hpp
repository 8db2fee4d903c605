// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <optional>
#include <string>

#include "node.hpp"
#include "orca/base/contract.hpp"
#include "orca/xml/rules.hpp"
#include "report.hpp"

namespace orca::graph {

// The value of a text as the contract wants it: of its type, in SI, in range, files absolute. Nothing if the
// text is unknown or wrong; what is wrong is reported after `title`.
std::optional<ParamValue> read_value(const Text& text, const ParamContract& contract,
                                     const std::string& title, Report& report);

// The value of an attribute as its rule wants it: a boolean, an integer, a number in SI, or a text.
std::optional<ParamValue> read_value(const Text& text, const xml::ValueRule& rule, const std::string& title,
                                     Report& report);

// A path as the text means it: absolute and without "..". It starts at the folder of the file that names it,
// or at the current one if the command line does.
std::string resolved_path(const std::string& path, const Text& origin);

}  // namespace orca::graph
