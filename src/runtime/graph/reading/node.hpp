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
  bool known = true;     // false: an error about it is reported, whatever follows from it is not
  std::string named_in;  // the file in which its beginning is written; empty: the command line
};

// How a file came into the graph: the <include> or <use> that names it, and how the file with that came in.
struct Origin {
  xml::Position position;
  const Origin* parent = nullptr;
  const xml::ElementRule* bringer = nullptr;  // the rule of that element

  // "main.xml:4:3", then what that was included by: "b.xml:2:3, included at main.xml:4:3".
  [[nodiscard]] std::string text() const;
};

// An element whose name and attributes follow the rules; slips that could be guessed are put right already.
struct Node {
  const xml::ElementRule* rule = nullptr;
  xml::Position position;
  std::map<std::string, Text, std::less<>> attributes;
  std::vector<Node> children;
  // Its name is taken: the node is checked, but never found by name.
  bool duplicate = false;
  const Origin* origin = nullptr;  // null: the file on the command line

  [[nodiscard]] bool is(std::string_view element) const { return rule->name == element; }
  [[nodiscard]] const Text* find(std::string_view attribute) const;
  // The attribute if it is there and can be judged.
  [[nodiscard]] const Text* known(std::string_view attribute) const;
  // Its value, or "" if it is missing or unknown.
  [[nodiscard]] std::string value(std::string_view attribute) const;
  // The attribute's place, or the element's.
  [[nodiscard]] const xml::Position& place(std::string_view attribute) const;
  // "component "avoid"": how messages call it.
  [[nodiscard]] std::string title() const;
  // Where it stands and how that file came in, for people.
  [[nodiscard]] std::string whereabouts() const;
};

}  // namespace orca::graph
