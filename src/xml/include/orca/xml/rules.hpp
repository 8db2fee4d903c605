// SPDX-License-Identifier: LGPL-3.0-or-later
// Tables of what a kind of file may hold: its elements, their attributes, and the values of the attributes.
#pragma once

#include <limits>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace orca::xml {

/// The value that an attribute must have.
struct ValueRule {
  enum class Form {
    text,     ///< Anything, or one of `choices`.
    name,     ///< A letter, then letters, digits and '_'; at most 200 characters.
    boolean,  ///< "true" or "false".
    integer,  ///< A whole number from `min` to `max`.
    number,   ///< A number from `min` to `max`, bare in SI or with a unit that measures the same as `unit`.
  };
  static constexpr double kUnlimited = std::numeric_limits<double>::infinity();

  Form form = Form::text;
  std::string_view unit = {};  ///< The SI unit of `min`, `max` and the value; empty: a plain number.
  double min = -kUnlimited;
  double max = kUnlimited;
  bool above_min = false;                          ///< `min` itself is not allowed.
  std::span<const std::string_view> choices = {};  ///< The only texts; empty: any.
};

struct AttributeRule {
  std::string_view name;
  bool required = false;
  std::string_view text = {};  ///< For people: what it says.
  ValueRule value = {};
};

/// The content that an element may hold.
struct ElementRule {
  std::string_view name;
  std::span<const AttributeRule> attributes = {};
  std::span<const ElementRule* const> children = {};
  std::string_view text = {};  ///< For people: what the element is.
  /// Attributes that identify the element: an unknown element with all of them is taken for this one. Empty:
  /// only the name identifies it.
  std::span<const std::string_view> telling = {};
  /// Attributes for other programs, which are skipped.
  std::span<const std::string_view> foreign = {};

  /// Returns the rule of an attribute or child, or null.
  [[nodiscard]] const AttributeRule* attribute(std::string_view wanted) const;
  [[nodiscard]] const ElementRule* child(std::string_view wanted) const;
  /// Returns the names of the attributes that can be used.
  [[nodiscard]] std::vector<std::string> attribute_names() const;
  [[nodiscard]] std::vector<std::string> child_names() const;
};

/// The codes that a kind of file gives to violations of its rules.
struct RuleCodes {
  const char* unknown_element;
  const char* misplaced_element = unknown_element;
  const char* unknown_attribute;
  const char* missing_attribute;
  const char* stray_text;
  const char* bad_value;
  const char* wrong_unit = bad_value;
  const char* out_of_range = bad_value;
  const char* unknown_choice = bad_value;
};

/// The rules of one kind of file.
struct FileRules {
  std::string_view title;                        ///< "a graph": how messages call such a file.
  std::span<const ElementRule* const> elements;  ///< The root first.
  RuleCodes codes;

  /// Returns the first rule of that name, or null.
  [[nodiscard]] const ElementRule* find(std::string_view element) const;
  /// Returns the elements that may contain `child`, for people: "<hardware> or <component>".
  [[nodiscard]] std::string parents_of(std::string_view child) const;
};

}  // namespace orca::xml
