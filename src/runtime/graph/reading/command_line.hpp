// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <map>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "node.hpp"
#include "report.hpp"

namespace orca::graph {

// The place of errors in what the command line sets.
[[nodiscard]] const xml::Position& command_line();

// What --set on the command line says. A name with a '.' is that of a parameter, as no argument can have one.
struct CommandLine {
  std::map<std::string, Text> arguments;   // by name
  std::set<std::string> valueless;         // arguments without a value, which is reported
  std::map<std::string, Text> parameters;  // by "component.param" or "hardware.param"
};

// Reads the settings, each "ARG=VALUE" or "COMPONENT.PARAM=VALUE", and reports those that are neither, or given twice.
[[nodiscard]] CommandLine read_command_line(const std::vector<std::string>& settings, Report& report);

// Returns an option and the name that it is about as messages show them: "--set avoid.gain", of bounded length.
[[nodiscard]] std::string shown_option(std::string_view option, std::string_view name);
[[nodiscard]] inline std::string shown_setting(std::string_view name) { return shown_option("--set", name); }

}  // namespace orca::graph
