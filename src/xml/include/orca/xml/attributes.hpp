// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "orca/base/time.hpp"
#include "orca/xml/matching.hpp"
#include "orca/xml/values.hpp"

namespace orca::xml {

/// The attributes of one element, read by their rules. Everything that is wrong with them is reported.
///
/// A reading function returns nothing if the attribute is missing or wrong. A missing attribute is reported
/// when this object is constructed, a wrong one when it is read. The object refers to its constructor's
/// arguments.
///
/// Thread contract: not synchronised; one thread.
class Attributes {
 public:
  /// Compares the attributes and the text of `element` with its rule, and reports where they differ.
  Attributes(const Element& element, const ElementRule& rule, const FileRules& file, Reporter& reporter);
  /// Reads an element without a rule, which may have any attributes.
  Attributes(const Element& element, const FileRules& file, Reporter& reporter);

  /// Values by the attribute's own rule, or by a rule without limits if it has none.
  [[nodiscard]] std::optional<double> number(std::string_view name) const;
  [[nodiscard]] std::optional<double> number_or(std::string_view name, double otherwise) const;
  [[nodiscard]] std::optional<std::int64_t> integer(std::string_view name) const;
  /// Returns a time that is written as a number in seconds.
  [[nodiscard]] std::optional<Duration> duration(std::string_view name) const;
  [[nodiscard]] std::optional<Duration> duration_or(std::string_view name, Duration otherwise) const;
  /// Returns one of the rule's choices.
  [[nodiscard]] std::optional<std::string> choice(std::string_view name) const;
  [[nodiscard]] std::optional<std::string> name(std::string_view attribute) const;
  [[nodiscard]] std::optional<std::string> text(std::string_view name) const;

  /// Values by a rule that only the reader knows.
  [[nodiscard]] std::optional<std::int64_t> integer(std::string_view name, const ValueRule& rule) const;
  [[nodiscard]] std::optional<std::string> choice(std::string_view name, const ValueRule& rule) const;

  /// Returns a number without a unit, not even "%".
  [[nodiscard]] std::optional<double> bare_number(std::string_view name) const;
  /// Returns bare numbers with blanks between them, exactly `n` of them.
  [[nodiscard]] std::optional<std::vector<double>> bare_numbers(std::string_view name, std::size_t n) const;
  /// Returns numbers with blanks between them, exactly `n`. The last word may be a unit for all: "90 45 0
  /// deg".
  [[nodiscard]] std::optional<std::vector<double>> numbers(std::string_view name, std::size_t n) const;

  [[nodiscard]] bool has(std::string_view name) const { return attribute(name) != nullptr; }
  /// Returns the attribute; null if it is missing.
  [[nodiscard]] const Attribute* attribute(std::string_view name) const;
  /// Returns the attribute; null if it is missing or if an error in it has been reported already.
  [[nodiscard]] const Attribute* readable(std::string_view name) const;
  /// Returns all attributes that have a rule, in document order.
  [[nodiscard]] const MatchedAttributes& matched() const { return matched_; }
  [[nodiscard]] const Element& element() const { return element_; }

  /// Reports a missing attribute. Returns true if it is there.
  bool require(std::string_view name) const;

  /// Finds the rules of the children, and reports children that have none.
  [[nodiscard]] std::vector<std::pair<const Element*, const ElementRule*>> children() const;
  /// Reads the attributes of a child that children() has returned.
  [[nodiscard]] Attributes of_child(const Element& child, const ElementRule& rule) const {
    return {child, rule, file_, reporter_};
  }

  /// Reports an error at the element, or at the value of one of its attributes.
  void error(const char* code, std::string message) const;
  void error_at(std::string_view attribute, const char* code, std::string message) const;
  /// Reports the same, and returns nothing.
  std::nullopt_t refuse(const char* code, std::string message) const;
  std::nullopt_t refuse_at(std::string_view attribute, const char* code, std::string message) const;
  /// Reports that the value of an attribute is not of the expected form.
  std::nullopt_t refuse_value(const Attribute& attribute, const ValueFault& fault) const;

 private:
  [[nodiscard]] ValueRule rule_of(std::string_view name) const;
  [[nodiscard]] std::optional<std::vector<double>> exactly(const Attribute& attribute, std::size_t n,
                                                           std::vector<double> values) const;

  const Element& element_;
  const ElementRule* rule_ = nullptr;  // null: anything goes
  const FileRules& file_;
  Reporter& reporter_;
  MatchedAttributes matched_;
};

/// Returns the pieces of a text, trimmed; "a; b" split at ';' gives "a", "b".
[[nodiscard]] std::vector<std::string_view> split(std::string_view text, std::string_view separators);
/// Returns the words of a text, which are separated by blanks, tabs or line ends.
[[nodiscard]] std::vector<std::string_view> words(std::string_view text);

}  // namespace orca::xml
