// SPDX-License-Identifier: LGPL-3.0-or-later
// Compares an element with its rule. A misspelt name is reported once and then treated as the name that was
// meant, so that one slip gives one error.
#pragma once

#include <string_view>
#include <utility>
#include <vector>

#include "orca/xml/document.hpp"
#include "orca/xml/reporter.hpp"
#include "orca/xml/rules.hpp"

namespace orca::xml {

/// The attributes of an element under the names of their rules, in document order.
using MatchedAttributes = std::vector<std::pair<std::string_view, const Attribute*>>;

/// Finds the rule of each attribute. Reports attributes that have none, and required attributes that are
/// missing.
[[nodiscard]] MatchedAttributes match_attributes(const Element& element, const ElementRule& rule,
                                                 const FileRules& file, Reporter& reporter);

/// Finds the rule of `child` among those that `parent` allows. Reports an element that is unknown or belongs
/// elsewhere.
/// @return null if the intended element cannot be guessed.
[[nodiscard]] const ElementRule* match_child(const Element& child, const ElementRule& parent,
                                             const FileRules& file, Reporter& reporter);

/// Reports text between the tags of the element.
void check_text(const Element& element, const FileRules& file, Reporter& reporter);

}  // namespace orca::xml
