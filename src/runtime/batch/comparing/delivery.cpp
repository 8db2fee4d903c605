// SPDX-License-Identifier: LGPL-3.0-or-later
#include <algorithm>
#include <sstream>
#include <vector>

#include "orca/base/text.hpp"
#include "orca/batch/difference.hpp"
#include "orca/xml/document.hpp"

namespace orca::batch {
namespace {

constexpr std::size_t kShownValues = 6;

// Takes the word before the next blank off a text.
std::string take_word(std::string_view& text) {
  const std::size_t end = std::min(text.find(' '), text.size());
  std::string word(text.substr(0, end));
  text.remove_prefix(std::min(end + 1, text.size()));
  return word;
}

std::vector<std::string> words_in(const std::string& text) {
  std::istringstream stream(text);
  std::vector<std::string> words;
  for (std::string word; stream >> word;) words.push_back(std::move(word));
  return words;
}

// The differences of two objects, as "PATH is VALUE in ONE and VALUE in OTHER".
class ValueDifferences {
 public:
  ValueDifferences(const std::string& one, const std::string& other) : one_(one), other_(other) {}

  std::vector<std::string> of(const Delivery& first, const Delivery& second) {
    xml::Diagnostics unused;
    const auto a = xml::read_text(first.value, "", unused);
    const auto b = xml::read_text(second.value, "", unused);
    if (a && b && a->root.name() == b->root.name()) compare(a->root, b->root, "");
    if (found_.empty()) add("the object", first.value, second.value);
    return std::move(found_);
  }

 private:
  void compare(const xml::Element& a, const xml::Element& b, const std::string& path) {
    for (const xml::Attribute& value : a.attributes()) {
      const xml::Attribute* const its = b.attribute(value.name);
      compare_values(path + value.name, value.value, its == nullptr ? "" : its->value);
    }
    for (const xml::Attribute& value : b.attributes())
      if (a.attribute(value.name) == nullptr) add(path + value.name, "", value.value);
    compare_children(a.children(), b.children(), path);
  }

  void compare_children(const std::vector<xml::Element>& a, const std::vector<xml::Element>& b,
                        const std::string& path) {
    if (!std::ranges::equal(a, b, {}, &xml::Element::name, &xml::Element::name))
      return add("the number of elements in " + (path.empty() ? "the object" : path),
                 std::to_string(a.size()), std::to_string(b.size()));
    for (std::size_t i = 0; i < a.size(); ++i) {
      const bool is_list = std::ranges::count(a, a[i].name(), &xml::Element::name) > 1;
      compare(a[i], b[i], path + a[i].name() + (is_list ? "[" + std::to_string(i) + "]" : "") + ".");
    }
  }

  // A list is one attribute with blanks between its values.
  void compare_values(const std::string& name, const std::string& a, const std::string& b) {
    if (a == b) return;
    const std::vector<std::string> as = words_in(a);
    const std::vector<std::string> bs = words_in(b);
    if (as.size() < 2 || as.size() != bs.size()) return add(name, a, b);
    for (std::size_t i = 0; i < as.size(); ++i)
      if (as[i] != bs[i]) add(name + "[" + std::to_string(i) + "]", as[i], bs[i]);
  }

  void add(const std::string& name, const std::string& a, const std::string& b) {
    const auto shown = [](const std::string& value) {
      return value.empty() ? "nothing" : shortened(value, 200);
    };
    found_.push_back(name + " is " + shown(a) + " in " + one_ + " and " + shown(b) + " in " + other_);
  }

  const std::string one_;
  const std::string other_;
  std::vector<std::string> found_;
};

}  // namespace

std::string Delivery::text() const {
  return type + " " + seq + " of " + origin + " to " + component + "." + port + " at " + time + " s";
}

std::optional<Delivery> read_delivery(std::string_view line) {
  Delivery delivery;
  delivery.time = take_word(line);
  if (take_word(line) != "deliver") return std::nullopt;
  for (std::string* const word : {&delivery.component, &delivery.port, &delivery.seq, &delivery.type})
    *word = take_word(line);
  if (take_word(line) != "from") return std::nullopt;
  delivery.origin = take_word(line);
  delivery.value = line;
  return delivery;
}

std::string DeliveryDifference::text(const std::string& one, const std::string& other) const {
  const std::string place = "delivery " + std::to_string(number) + ", ";
  if (!first && !second) return "no delivery";
  if (!first) return place + second->text() + ", is in " + other + " only; " + one + " has no more";
  if (!second) return place + first->text() + ", is in " + one + " only; " + other + " has no more";
  if (first->text() != second->text())
    return place + "is " + first->text() + " in " + one + ", but " + second->text() + " in " + other;
  const std::vector<std::string> values = ValueDifferences(one, other).of(*first, *second);
  return place + first->text() + ": " + listed(values, kShownValues);
}

}  // namespace orca::batch
