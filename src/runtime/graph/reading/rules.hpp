// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "orca/xml/document.hpp"

namespace orca::graph {

struct AttributeRule {
  std::string_view name;
  bool required = false;
  std::string_view text;                           // for people: what it says
  std::span<const std::string_view> choices = {};  // the only values; empty: any
};

// What the graph's XML may look like, one entry per element.
struct ElementRule {
  enum class Support {
    full,
    transparent,  // not yet, but its content can be looked at as if it stood outside
  };
  std::string_view name;
  std::span<const AttributeRule> attributes;
  std::span<const std::string_view> children;
  std::string_view text;  // for people: what the element is
  Support support = Support::full;

  [[nodiscard]] const AttributeRule* attribute(std::string_view wanted) const;
  [[nodiscard]] bool allows(std::string_view child) const;
  // The rule of an allowed child.
  [[nodiscard]] const ElementRule* child(std::string_view element) const;
  // The child that `element` was probably meant to be: the one with the nearest name, or <connect> if it has
  // its two ends. Null if there is no telling.
  [[nodiscard]] const ElementRule* guess_child(const xml::Element& element) const;
  [[nodiscard]] std::vector<std::string> attribute_names() const;
  [[nodiscard]] std::vector<std::string> child_names() const;
};

// Whether the element brings in another file.
bool brings_file(const ElementRule& rule);
// The attribute of such an element that names the file.
const char* file_attribute(const ElementRule& rule);

// The rule of an element, or null. An <arg> may also be what an <include> or a <use> gives to its file, which
// only ElementRule::child() tells.
const ElementRule* find_rule(std::string_view element);

// All elements, in the order of the schema.
std::span<const ElementRule> all_rules();

// The elements that may contain `child`, for people: "<hardware> or <component>".
std::string parents_of(std::string_view child);

}  // namespace orca::graph
