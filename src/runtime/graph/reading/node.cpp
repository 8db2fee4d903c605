// SPDX-License-Identifier: LGPL-3.0-or-later
#include "node.hpp"

#include "orca/base/text.hpp"
#include "report.hpp"

namespace orca::graph {

const Text* Node::find(std::string_view attribute) const {
  const auto found = attributes.find(attribute);
  return found == attributes.end() ? nullptr : &found->second;
}

const Text* Node::known(std::string_view attribute) const {
  const Text* text = find(attribute);
  return text != nullptr && text->known ? text : nullptr;
}

std::string Node::value(std::string_view attribute) const {
  const Text* text = known(attribute);
  return text == nullptr ? "" : text->value;
}

const xml::Position& Node::place(std::string_view attribute) const {
  const Text* text = find(attribute);
  return text == nullptr ? position : text->position;
}

std::string Origin::text() const {
  std::string result = position.text();
  for (const Origin* up = parent; up != nullptr; up = up->parent)
    result += ", included at " + up->position.text();
  return result;
}

std::string Node::whereabouts() const {
  return position.text() + (origin == nullptr ? "" : ", included at " + origin->text());
}

std::string Node::title() const {
  if (is("change")) return "<change>";
  const Text* name = known("name");
  return std::string(rule->name) + (name == nullptr ? " without a name" : " " + in_quotes(name->value));
}

}  // namespace orca::graph
