// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <map>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "budget.hpp"
#include "command_line.hpp"
#include "node.hpp"
#include "orca/xml/document.hpp"
#include "report.hpp"

namespace orca::graph {

// The <arg>s of one file, with the values set by the command line or by the <include> or <use> that names the
// file. They replace ${...} in attribute values.
class Arguments {
 public:
  // @param line  its arguments are those of the file that it names.
  Arguments(const CommandLine& line, Budget& budget, Report& report);
  // @param bringer  the <include> or <use>; its <arg>s are the settings.
  Arguments(const Node& bringer, Budget& budget, Report& report);

  // Gives an argument a value, unless the file declares one of that name.
  void predefine(const std::string& name, const xml::Attribute& value);

  // Declares an <arg>. Its default may refer to arguments declared before.
  void declare(const Node& arg);

  // Returns the attribute's value with ${arg} replaced and $$ made $.
  Text replaced(const xml::Attribute& attribute);

  // Reports settings that no <arg> takes and arguments that nothing uses.
  void check_use();

 private:
  struct Argument {
    Text value;
    xml::Position position;
    bool without_value = false;  // it has no default and is not set
    bool used = false;
    bool is_predefined = false;
  };
  struct Setting {
    Text value;
    xml::Position position;  // of the setting's name
    bool used = false;
  };

  void report_duplicate(const std::string& name, const Node& arg);
  void report_without_value(const std::string& name, const Argument& argument);
  // Reports the error and returns the argument that the setting was probably meant for.
  std::optional<std::string> report_no_such_argument(const std::string& name, const Setting& setting);
  Argument read(const std::string& name, const Node& arg);
  // Replaces the reference at the '$' that `rest` starts with, and removes it from `rest`.
  void replace_one(std::string_view& rest, Text& text);
  void append(const std::string& name, Text& text);
  void report_undefined(const std::string& name, const Text& text);

  Budget& budget_;
  Report& report_;
  const Node* bringer_ = nullptr;  // null: the command line
  std::map<std::string, Setting> settings_;
  std::set<std::string> valueless_;  // set on the command line without a value, which is reported
  std::map<std::string, Argument> arguments_;
  std::vector<std::string> names_;  // of arguments_, in the order of the file
};

}  // namespace orca::graph
