// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <initializer_list>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "orca/base/time.hpp"
#include "orca/sim/geometry.hpp"
#include "orca/xml/document.hpp"

namespace orca::sim::detail {

enum class Sign { any, not_negative, positive };

// Reads the attributes of one element and reports whatever is wrong with them. World and robot files share
// the numbers of these errors and differ in the letter before them.
class Attributes {
 public:
  Attributes(const xml::Element& element, char letter, xml::Diagnostics& diagnostics)
      : element_(element), letter_(letter), diagnostics_(diagnostics) {}

  // 002, 003, 006: reports children, attributes and text that do not belong here.
  void allow(const std::vector<std::string>& attributes, const std::vector<std::string>& children) const;

  // Each gives nothing if the attribute is missing (004, but for the ones with a default) or wrong (005).
  [[nodiscard]] std::optional<double> quantity(std::string_view name, std::string_view unit, Sign sign) const;
  [[nodiscard]] std::optional<double> quantity_or(std::string_view name, std::string_view unit, Sign sign,
                                                  double otherwise) const;
  [[nodiscard]] std::optional<Duration> duration(std::string_view name, Sign sign) const;
  [[nodiscard]] std::optional<Duration> duration_or(std::string_view name, Duration otherwise) const;
  [[nodiscard]] std::optional<std::size_t> count(std::string_view name, std::size_t low,
                                                 std::size_t high) const;
  [[nodiscard]] std::optional<Vec2> point(std::string_view name) const;
  [[nodiscard]] std::optional<std::vector<Vec2>> points(std::string_view name) const;
  // A word out of `choices`.
  [[nodiscard]] std::optional<std::string> choice(std::string_view name,
                                                  const std::vector<std::string>& choices) const;
  // Bare numbers with blanks between them, exactly `n` of them.
  [[nodiscard]] std::optional<std::vector<double>> numbers(std::string_view name, std::size_t n) const;
  [[nodiscard]] std::optional<double> number(std::string_view name) const;
  // Numbers with blanks between them, exactly `n`; the last word may be a unit for all: "90 45 0 deg".
  [[nodiscard]] std::optional<std::vector<double>> quantities(std::string_view name, std::string_view unit,
                                                              std::size_t n) const;
  // A name as in graphs: a letter, then letters, digits and underscores.
  [[nodiscard]] std::optional<std::string> name(std::string_view attribute) const;
  [[nodiscard]] std::optional<std::string> text(std::string_view name) const;
  [[nodiscard]] std::string text_or(std::string_view name, std::string otherwise) const;

  [[nodiscard]] bool has(std::string_view name) const { return element_.attribute(name) != nullptr; }
  [[nodiscard]] const xml::Element& element() const { return element_; }
  [[nodiscard]] xml::Diagnostics& diagnostics() const { return diagnostics_; }

  // An error of number `code` at the element, or at the value of one of its attributes.
  void error(int code, const std::string& message) const;
  void error_at(std::string_view attribute, int code, const std::string& message) const;

 private:
  [[nodiscard]] const xml::Attribute* required(std::string_view name) const;
  [[nodiscard]] std::optional<double> checked(const xml::Attribute& attribute, std::string_view unit,
                                              Sign sign) const;
  [[nodiscard]] std::optional<std::vector<double>> exactly(const xml::Attribute& attribute, std::size_t n,
                                                           std::vector<double> values) const;
  [[nodiscard]] std::optional<Vec2> point_in(const xml::Attribute& attribute, std::string_view text) const;
  void wrong(const xml::Attribute& attribute, const std::string& message) const;
  [[nodiscard]] std::string code(int number) const;

  const xml::Element& element_;
  char letter_;
  xml::Diagnostics& diagnostics_;
};

// Pieces of a list, trimmed; "a; b" at ';' gives "a", "b".
[[nodiscard]] std::vector<std::string_view> split(std::string_view text, std::string_view separators);

}  // namespace orca::sim::detail
