// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "orca/xml/diagnostics.hpp"
#include "rules.hpp"

namespace orca::graph {

// An attribute's value after the replacement of ${...}.
struct Text {
  std::string value;
  xml::Position position;
  bool known = true;     // false: its error is reported, and the errors that follow from it are not
  std::string named_in;  // the file that contains its beginning; empty: the command line
};

// The way by which a file came into the graph: the <include> or <use> that names it, and its origin.
struct Origin {
  xml::Position position;
  const Origin* parent = nullptr;
  const xml::ElementRule* bringer = nullptr;  // the rule of that element

  // Returns the place, then the files that include it: "b.xml:2:3, included at main.xml:4:3".
  [[nodiscard]] std::string text() const;
};

// An element whose name and attributes follow the rules. Slips that could be guessed are corrected already.
struct Node {
  const xml::ElementRule* rule = nullptr;
  xml::Position position;
  std::map<std::string, Text, std::less<>> attributes;
  std::vector<Node> children;
  // Whether its name is taken. Such a node is checked, but never found by name.
  bool duplicate = false;
  const Origin* origin = nullptr;  // null: the file on the command line
  std::string context{};           // that <use> has put before the names in it, with a '/' at its end

  [[nodiscard]] bool is(std::string_view element) const { return rule->name == element; }
  [[nodiscard]] const Text* find(std::string_view attribute) const;
  // Returns the attribute if it exists and its value is known, else null.
  [[nodiscard]] const Text* known(std::string_view attribute) const;
  // Returns its value, or "" if it is missing or unknown.
  [[nodiscard]] std::string value(std::string_view attribute) const;
  // Returns the attribute's place, or the element's.
  [[nodiscard]] const xml::Position& place(std::string_view attribute) const;
  // Returns its name in messages: component "avoid".
  [[nodiscard]] std::string title() const;
  // Returns its place and the origin of its file, for people.
  [[nodiscard]] std::string whereabouts() const;
};

}  // namespace orca::graph
