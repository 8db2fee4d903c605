// SPDX-License-Identifier: LGPL-3.0-or-later
#include "constraint.hpp"

#include <array>
#include <utility>

#include "orca/xml/number.hpp"
#include "properties.hpp"
#include "reading/naming.hpp"

namespace orca::graph {
namespace {

// The longer ones first, because the shorter ones begin them.
constexpr std::array<std::pair<std::string_view, Comparison>, 7> kOperators{{{"==", Comparison::equal},
                                                                             {"!=", Comparison::unequal},
                                                                             {">=", Comparison::at_least},
                                                                             {"<=", Comparison::at_most},
                                                                             {">", Comparison::more},
                                                                             {"<", Comparison::less},
                                                                             {"=", Comparison::equal}}};

constexpr const char* kValueExpected =
    "a value is expected: a number with its unit, true, false, or a text between quotes, such as 'Dewey'";

bool is_blank(char c) { return c == ' ' || c == '\t' || c == '\n' || c == '\r'; }
bool may_be_in_name(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_';
}

// A reader of one text, from its beginning to its end.
class Parser {
 public:
  Parser(std::string_view text, ConstraintFault& fault) : text_(text), fault_(fault) {}

  std::optional<Constraint> constraint() {
    Constraint terms;
    do {
      auto read = term();
      if (!read) return std::nullopt;
      terms.push_back(*std::move(read));
    } while (skip(";"));
    return terms;
  }

  std::optional<Preference> preference() {
    const std::string word = name();
    if (word != "max" && word != "min") return expected(0, "max or min, and then a property, is expected");
    const std::size_t begin = position_;
    Preference preference{name(), word == "max"};
    if (preference.name.empty()) return expected(begin, "the name of a property is expected");
    if (!at_end()) return expected(position_, "nothing more is expected");
    return preference;
  }

 private:
  std::optional<Term> term() {
    skip_blanks();
    const std::size_t begin = position_;
    Term term;
    term.name = name();
    if (term.name.empty() || name_fault(term.name))
      return expected(begin, "the name of a property is expected");
    const auto comparison = this->comparison();
    if (!comparison) return expected(position_, "one of == != >= <= > < is expected");
    term.comparison = *comparison;
    auto value = this->value();
    if (!value) return std::nullopt;
    term.value = *std::move(value);
    const bool has_order = std::holds_alternative<Quantity>(term.value);
    if (!has_order && term.comparison != Comparison::equal && term.comparison != Comparison::unequal)
      return expected(begin, "only numbers are compared with " + std::string(to_string(term.comparison)) +
                                 "; take == or !=");
    return term;
  }

  std::string name() {
    skip_blanks();
    const std::size_t begin = position_;
    while (position_ < text_.size() && may_be_in_name(text_[position_])) ++position_;
    return std::string(text_.substr(begin, position_ - begin));
  }

  std::optional<Comparison> comparison() {
    for (const auto& [sign, comparison] : kOperators)
      if (skip(sign)) return comparison;
    return std::nullopt;
  }

  std::optional<PropertyValue> value() {
    skip_blanks();
    const std::size_t begin = position_;
    const std::string_view written = xml::trimmed(rest_of_term());
    const auto read = read_marked_value(written);
    if (!read) return expected(begin, kValueExpected);
    if (!*read) return expected(begin, read->error().message);
    return **read;
  }

  // Takes everything up to the next ';' that is not between quotes.
  std::string_view rest_of_term() {
    const std::size_t begin = position_;
    char quote = 0;
    for (; position_ < text_.size(); ++position_) {
      const char c = text_[position_];
      if (quote == 0 && c == ';') break;
      if (quote != 0 && c == quote)
        quote = 0;
      else if (quote == 0 && is_quote(c))
        quote = c;
    }
    return text_.substr(begin, position_ - begin);
  }

  bool skip(std::string_view sign) {
    skip_blanks();
    if (!text_.substr(position_).starts_with(sign)) return false;
    position_ += sign.size();
    return true;
  }

  void skip_blanks() {
    while (position_ < text_.size() && is_blank(text_[position_])) ++position_;
  }

  bool at_end() {
    skip_blanks();
    return position_ == text_.size();
  }

  std::nullopt_t expected(std::size_t where, std::string message) {
    while (where < text_.size() && is_blank(text_[where])) ++where;
    // A character beyond ASCII has several bytes, of which the first counts.
    fault_.column = 1;
    for (const char c : text_.substr(0, where)) fault_.column += (c & 0xC0) == 0x80 ? 0 : 1;
    fault_.message = std::move(message);
    return std::nullopt;
  }

  const std::string_view text_;
  std::size_t position_ = 0;
  ConstraintFault& fault_;
};

bool compare(double a, Comparison comparison, double b) {
  switch (comparison) {
    case Comparison::equal: return a == b;
    case Comparison::unequal: return a != b;
    case Comparison::at_least: return a >= b;
    case Comparison::at_most: return a <= b;
    case Comparison::more: return a > b;
    case Comparison::less: return a < b;
  }
  return false;
}

}  // namespace

const char* to_string(Comparison comparison) {
  for (const auto& [sign, named] : kOperators)
    if (named == comparison) return sign.data();
  return "?";
}

std::string Term::text() const { return name + " " + to_string(comparison) + " " + constraint_text(value); }

std::optional<Constraint> parse_constraint(std::string_view text, ConstraintFault& fault) {
  return Parser(text, fault).constraint();
}

std::optional<Preference> parse_preference(std::string_view text, ConstraintFault& fault) {
  return Parser(text, fault).preference();
}

bool looks_like_constraint(std::string_view text) {
  return text.find_first_of("=<>!\"'") != std::string_view::npos;
}

bool are_comparable(const Quantity& a, const Quantity& b) {
  return a.unit == b.unit || a.unit.empty() || b.unit.empty();
}

TermOutcome evaluate(const Term& term, const PropertyValue& property) {
  if (term.value.index() != property.index()) return TermOutcome::incomparable;
  if (const auto* number = std::get_if<Quantity>(&property)) {
    const Quantity& wanted = std::get<Quantity>(term.value);
    if (!are_comparable(*number, wanted)) return TermOutcome::incomparable;
    return compare(number->value, term.comparison, wanted.value) ? TermOutcome::holds : TermOutcome::misses;
  }
  const bool equal = term.value == property;
  return equal == (term.comparison == Comparison::equal) ? TermOutcome::holds : TermOutcome::misses;
}

}  // namespace orca::graph
