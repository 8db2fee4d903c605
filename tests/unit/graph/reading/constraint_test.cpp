// SPDX-License-Identifier: GPL-3.0-or-later
// The language in which a graph says what it seeks.
#include "reading/trading/constraint.hpp"

#include <catch2/catch.hpp>

#include "orca/base/random.hpp"
#include "reading/trading/properties.hpp"

using namespace orca;
using namespace orca::graph;

namespace {

Constraint must_parse(const std::string& text) {
  ConstraintFault fault;
  const auto constraint = parse_constraint(text, fault);
  INFO(text << ": column " << fault.column << ": " << fault.message);
  REQUIRE(constraint.has_value());
  return *constraint;
}

// Returns "COLUMN: MESSAGE" about a text that is no constraint.
std::string fault_of(const std::string& text) {
  ConstraintFault fault;
  REQUIRE_FALSE(parse_constraint(text, fault).has_value());
  return std::to_string(fault.column) + ": " + fault.message;
}

bool holds(const std::string& constraint, const PropertyValue& property) {
  return evaluate(must_parse(constraint).front(), property) == TermOutcome::holds;
}

std::size_t below(RandomStream& random, std::size_t limit) {
  return static_cast<std::size_t>(random.uniform(0.0, static_cast<double>(limit)));
}

bool comparable(const std::string& constraint, const PropertyValue& property) {
  return evaluate(must_parse(constraint).front(), property) != TermOutcome::incomparable;
}

}  // namespace

TEST_CASE("a constraint is terms, each a name, a comparison and a value", "[graph][trading]") {
  const Constraint constraint = must_parse(" platform=='Dewey' ; accuracy <= 10 cm;indoors != false ");
  REQUIRE(constraint.size() == 3);
  CHECK(constraint[0].name == "platform");
  CHECK(constraint[0].comparison == Comparison::equal);
  CHECK(constraint[0].value == PropertyValue(std::string("Dewey")));
  CHECK(constraint[1].comparison == Comparison::at_most);
  CHECK(constraint[1].value == PropertyValue(Quantity{0.1, "m"}));
  CHECK(constraint[2].value == PropertyValue(false));
}

TEST_CASE("one equals sign means the same as two", "[graph][trading]") {
  CHECK(must_parse("a = 1").front().comparison == Comparison::equal);
}

TEST_CASE("a text may hold the other kind of quote, and a semicolon", "[graph][trading]") {
  CHECK(must_parse("room == \"Ola's; at the left\"").front().value ==
        PropertyValue(std::string("Ola's; at the left")));
  CHECK(must_parse("room == '\"'; a == 1").size() == 2);
}

TEST_CASE("a fault has its column and what was expected there", "[graph][trading]") {
  const std::string name = "the name of a property is expected";
  const std::string value =
      "a value is expected: a number with its unit, true, false, or a text between quotes, such as 'Dewey'";
  const std::string comparison = "one of == != >= <= > < is expected";
  CHECK(fault_of("") == "1: " + name);
  CHECK(fault_of("  ") == "3: " + name);
  CHECK(fault_of("a == 1;") == "8: " + name);
  CHECK(fault_of("a == 1;; b == 2") == "8: " + name);
  CHECK(fault_of("== 1") == "1: " + name);
  CHECK(fault_of("1a == 1") == "1: " + name);
  CHECK(fault_of("a") == "2: " + comparison);
  CHECK(fault_of("a b == 1") == "3: " + comparison);
  CHECK(fault_of("a => 1") == "4: " + value);  // "=", and then "> 1"
  CHECK(fault_of("a ==") == "5: " + value);
  CHECK(fault_of("a == Dewey") == "6: " + value);
  CHECK(fault_of("a == 1; b == x") == "14: " + value);
}

TEST_CASE("columns count characters, not bytes", "[graph][trading]") {
  CHECK(fault_of("room == 'Käte'; b ? 1").starts_with("19: "));
}

TEST_CASE("a value must be right to its end", "[graph][trading]") {
  CHECK(fault_of("a == 1 parsec") == "6: \"1 parsec\": \"parsec\" is not a unit that Orca knows");
  CHECK(fault_of("a == 'x") == "6: \"'x\": the quote is not closed");
  CHECK(fault_of("a == 'x' y") == "6: \"'x' y\": something follows the closing quote");
  CHECK(fault_of("a == 'x' or b == 'y'") == "6: \"'x' or b == 'y'\": something follows the closing quote");
}

TEST_CASE("only numbers are greater or smaller", "[graph][trading]") {
  CHECK(fault_of("a >= 'x'") == "1: only numbers are compared with >=; take == or !=");
  CHECK(fault_of("b == 1; a < true") == "9: only numbers are compared with <; take == or !=");
}

TEST_CASE("numbers are compared in SI", "[graph][trading]") {
  const PropertyValue accuracy = Quantity{0.1, "m"};
  CHECK(holds("accuracy <= 100 mm", accuracy));
  CHECK(holds("accuracy >= 10 cm", accuracy));
  CHECK(holds("accuracy == 0.1", accuracy));
  CHECK_FALSE(holds("accuracy < 0.1 m", accuracy));
  CHECK_FALSE(holds("accuracy > 0.1 m", accuracy));
  CHECK_FALSE(holds("accuracy != 0.1 m", accuracy));
}

TEST_CASE("what measures something else cannot be compared", "[graph][trading]") {
  CHECK_FALSE(comparable("a >= 1 s", Quantity{1.0, "m"}));
  CHECK_FALSE(comparable("a != 'x'", Quantity{1.0, ""}));
  CHECK_FALSE(comparable("a == true", std::string("true")));
  CHECK(comparable("a >= 1", Quantity{1.0, "m"}));
  CHECK(comparable("a >= 1 m", Quantity{1.0, ""}));
}

TEST_CASE("texts are equal to the letter", "[graph][trading]") {
  CHECK(holds("p == 'Dewey'", std::string("Dewey")));
  CHECK_FALSE(holds("p == 'Dewey'", std::string("dewey")));
  CHECK(holds("p != 'Dewey'", std::string("Huey")));
}

TEST_CASE("a preference is max or min and a property", "[graph][trading]") {
  ConstraintFault fault;
  const auto preference = parse_preference(" max  quality ", fault);
  REQUIRE(preference.has_value());
  CHECK(preference->name == "quality");
  CHECK(preference->largest);
  CHECK_FALSE(parse_preference("min cost", fault)->largest);
  CHECK_FALSE(parse_preference("most quality", fault).has_value());
  CHECK(fault.column == 1);
  CHECK_FALSE(parse_preference("max", fault).has_value());
  CHECK_FALSE(parse_preference("max a b", fault).has_value());
  CHECK(fault.column == 7);
}

TEST_CASE("a printed term reads back the same, for values at random", "[graph][trading]") {
  RandomStream random(7, "constraint", "round trip");
  const std::string letters = "a1.'; =\"-+e%m ";
  for (int i = 0; i < 2000; ++i) {
    std::string text;
    for (std::size_t n = below(random, 8); n > 0; --n) text += letters[below(random, letters.size())];
    const bool has_both = text.find('\'') != std::string::npos && text.find('"') != std::string::npos;
    if (has_both) continue;  // nobody can write it as a value
    for (const PropertyValue& value :
         {PropertyValue(text), PropertyValue(Quantity{random.uniform(-9.0, 9.0), "m"}),
          PropertyValue(true)}) {
      const Term term{"p", Comparison::unequal, value};
      INFO(term.text());
      CHECK(must_parse(term.text()).front().value == value);
      const std::string written = property_text(value);
      const auto marked = read_marked_value(written);
      CHECK((marked ? **marked : PropertyValue(written)) == value);
    }
  }
}
