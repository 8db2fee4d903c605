// SPDX-License-Identifier: LGPL-3.0-or-later
#include "orca/xml/schema.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <map>
#include <set>
#include <utility>

#include "orca/xml/document.hpp"
#include "orca/xml/number.hpp"
#include "orca/xml/quantity.hpp"

namespace orca::xml {
namespace {

using Form = ValueRule::Form;

constexpr const char* kArgument = "with_argument";

// Keeps the lines of the text, which escaped() would write as characters.
std::string documentation(const std::string& text, const std::string& indent) {
  if (text.empty()) return {};
  std::string lines;
  for (std::size_t start = 0; start <= text.size();) {
    const std::size_t end = std::min(text.find('\n', start), text.size());
    lines += (start == 0 ? "" : "\n") + escaped(text.substr(start, end - start));
    start = end + 1;
  }
  return indent + "<xs:annotation><xs:documentation>" + lines + "</xs:documentation></xs:annotation>\n";
}

// Returns "From 0 to 86400 s.", or nothing if everything is allowed.
std::string range_text(const ValueRule& rule) {
  if (rule.form != Form::number && rule.form != Form::integer) return {};
  const std::string unit = rule.unit.empty() ? "" : " " + std::string(rule.unit);
  std::string text;
  if (std::isfinite(rule.min))
    text = (rule.above_min ? "More than " : "From ") + number_text(rule.min) +
           (std::isfinite(rule.max) ? "" : unit);
  if (std::isfinite(rule.max)) text += (text.empty() ? "Up to " : " to ") + number_text(rule.max) + unit;
  if (text.empty() && !unit.empty()) text = "In" + unit;
  return text.empty() ? text : text + ".";
}

std::string with_range(std::string_view text, const ValueRule& rule) {
  const std::string range = range_text(rule);
  return std::string(text) + (text.empty() || range.empty() ? "" : " ") + range;
}

// Returns a unit as a part of a type's name: "m/s2" is "m_per_s2".
std::string name_part(std::string_view unit) {
  std::string name = unit.empty() ? "one" : std::string(unit);
  if (const auto slash = name.find('/'); slash != std::string::npos) name.replace(slash, 1, "_per_");
  return name;
}

// Returns a pattern of numbers with blanks between them, each with one of the unit's names or without.
std::string numbers_pattern(std::string_view si) {
  std::string units;
  for (const std::string_view unit : units_of(si)) units += (units.empty() ? "" : "|") + std::string(unit);
  const std::string number = "[+\\-]?([0-9]+\\.?[0-9]*|\\.[0-9]+)([eE][+\\-]?[0-9]+)?(\\s*(" + units + "))?";
  return "\\s*" + number + "(\\s+" + number + ")*\\s*";
}

std::string pattern_type(const std::string& pattern) {
  return "<xs:restriction base=\"xs:string\"><xs:pattern value=\"" + pattern + "\"/></xs:restriction>";
}

// Returns whether a double holds every whole number up to this one.
bool is_exact(double value) { return std::fabs(value) < 9e15; }

std::string whole_number_type(const ValueRule& rule) {
  std::string facets;
  if (is_exact(rule.min))
    facets += "<xs:minInclusive value=\"" + std::to_string(std::llround(rule.min)) + "\"/>";
  if (is_exact(rule.max))
    facets += "<xs:maxInclusive value=\"" + std::to_string(std::llround(rule.max)) + "\"/>";
  return "<xs:restriction base=\"xs:integer\">" + facets + "</xs:restriction>";
}

// A writer of one schema. Its types are named after elements; the second rule of one name is named after its parent too.
class Writer {
 public:
  Writer(const FileRules& file, const SchemaOptions& options) : file_(file), options_(options) {}

  std::string write() {
    std::set<const ElementRule*> inner;
    for (const ElementRule* rule : file_.elements)
      for (const ElementRule* child : rule->children) inner.insert(child);
    std::string roots;
    for (const ElementRule* rule : file_.elements) {
      if (inner.contains(rule)) continue;
      roots += element_text(*rule, "", "  ");
    }
    std::string types;
    for (std::size_t next = 0; next < pending_.size(); ++next) types += type_text(next);
    std::string values;
    if (options_.has_arguments) values = named_type(kArgument, pattern_type(".*[$]\\{.*\\}.*"));
    for (const auto& [name, text] : value_types_) values += text;
    return "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
           "<!-- SPDX-License-Identifier: LGPL-3.0-or-later -->\n<!-- " +
           options_.title +
           ", for editors. Written by Orca from the rules that it reads by -->\n"
           "<xs:schema xmlns:xs=\"http://www.w3.org/2001/XMLSchema\">\n" +
           values + roots + types + "</xs:schema>\n";
  }

 private:
  struct Pending {
    const ElementRule* rule;
    std::string parent;
    std::string name;
  };

  static std::string named_type(const std::string& name, const std::string& content) {
    return "  <xs:simpleType name=\"" + name + "\">\n    " + content + "\n  </xs:simpleType>\n";
  }

  [[nodiscard]] const Vocabulary* vocabulary(std::string_view element, std::string_view parent,
                                             std::string_view attribute) const {
    for (const Vocabulary& one : options_.vocabularies)
      if (one.element == element && (one.parent.empty() || one.parent == parent) &&
          one.attribute == attribute)
        return &one;
    return nullptr;
  }

  // Returns whether the element has words of its own within this parent.
  [[nodiscard]] bool is_special(const ElementRule& rule, std::string_view parent) const {
    return std::ranges::any_of(options_.vocabularies, [&](const Vocabulary& one) {
      return one.element == rule.name && !one.parent.empty() && one.parent == parent;
    });
  }

  // Returns the name of the element's type, which is written later.
  std::string type_of(const ElementRule& rule, const std::string& parent) {
    const std::string plain(rule.name);
    const bool is_taken = std::ranges::any_of(
        pending_, [&](const Pending& one) { return one.name == plain && one.rule != &rule; });
    std::string name = plain;
    if (is_special(rule, parent)) {
      name = plain + "_in_" + parent;
    } else if (is_taken) {
      const auto same = std::ranges::find(pending_, &rule, &Pending::rule);
      name = same == pending_.end() ? plain + "_in_" + parent : same->name;
    }
    if (std::ranges::find(pending_, name, &Pending::name) == pending_.end())
      pending_.push_back({&rule, parent, name});
    return name;
  }

  std::string element_text(const ElementRule& rule, const std::string& parent, const std::string& indent) {
    const std::string start =
        indent + "<xs:element name=\"" + std::string(rule.name) + "\" type=\"" + type_of(rule, parent) + "\"";
    std::string content;
    for (const UniqueNames& one : options_.unique) {
      if (one.element != rule.name) continue;
      const std::string name = "unique_" + std::string(one.children) + "_in_" + std::string(rule.name) +
                               (parent.empty() ? "" : "_of_" + parent);
      content += indent + "  <xs:unique name=\"" + name + "\"><xs:selector xpath=\"" +
                 std::string(one.children) + "\"/><xs:field xpath=\"@name\"/></xs:unique>\n";
    }
    return content.empty() ? start + "/>\n" : start + ">\n" + content + indent + "</xs:element>\n";
  }

  std::string type_text(std::size_t index) {
    const Pending one = pending_[index];  // a copy, as others are added
    const bool is_open = one.parent.empty() && !options_.others.empty();
    std::string children;
    for (const ElementRule* child : one.rule->children)
      children += element_text(*child, std::string(one.rule->name), "      ");
    if (is_open)
      for (const std::string_view other : options_.others)
        children += "      <xs:element name=\"" + std::string(other) + "\"/>\n";
    std::string text =
        "  <xs:complexType name=\"" + one.name + "\">\n" + documentation(std::string(one.rule->text), "    ");
    if (!children.empty())
      text += "    <xs:choice minOccurs=\"0\" maxOccurs=\"unbounded\">\n" + children + "    </xs:choice>\n";
    for (const AttributeRule& rule : one.rule->attributes) text += attribute_text(rule, one);
    if (is_open) text += "    <xs:anyAttribute processContents=\"skip\"/>\n";
    return text + "  </xs:complexType>\n";
  }

  std::string attribute_text(const AttributeRule& rule, const Pending& element) {
    const Vocabulary* words = vocabulary(element.rule->name, element.parent, rule.name);
    std::string start = "    <xs:attribute name=\"" + std::string(rule.name) + "\"";
    std::string content = documentation(with_range(rule.text, rule.value), "      ");
    const std::string type = value_type(rule.value);
    if (words == nullptr && rule.value.choices.empty()) {
      start += " type=\"" + type + "\"";
    } else {
      std::vector<SchemaWord> allowed;
      for (const std::string_view choice : rule.value.choices) allowed.push_back({std::string(choice), {}});
      if (words != nullptr) allowed = words->words;
      content += words_text(allowed, words != nullptr && !words->only ? type : "");
    }
    if (rule.required) start += " use=\"required\"";
    return content.empty() ? start + "/>\n" : start + ">\n" + content + "    </xs:attribute>\n";
  }

  // Returns a type that allows one of the words, an argument if the file has some, or what the other type allows.
  [[nodiscard]] std::string words_text(const std::vector<SchemaWord>& words, const std::string& other) const {
    std::string enumeration = "<xs:restriction base=\"xs:string\">\n";
    for (const SchemaWord& one : words) {
      enumeration += "              <xs:enumeration value=\"" + escaped(one.word) + "\"";
      enumeration += one.text.empty() ? "/>\n"
                                      : ">\n" + documentation(one.text, "                ") +
                                            "              </xs:enumeration>\n";
    }
    enumeration += "            </xs:restriction>\n";
    const std::string members = !other.empty() ? other : options_.has_arguments ? kArgument : "";
    return "      <xs:simpleType>\n        <xs:union" +
           (members.empty() ? "" : " memberTypes=\"" + members + "\"") +
           ">\n          <xs:simpleType>\n            " + enumeration +
           "          </xs:simpleType>\n        </xs:union>\n      </xs:simpleType>\n";
  }

  // Returns the type of values that follow a rule without choices.
  std::string value_type(const ValueRule& rule) {
    switch (rule.form) {
      case Form::text: return "xs:string";
      case Form::name: return value_type("name", pattern_type("\\s*[A-Za-z][A-Za-z0-9_]{0,199}\\s*"));
      case Form::boolean: return value_type("boolean", pattern_type("\\s*(true|false)\\s*"));
      case Form::integer:
        return value_type("whole_from_" + bound(rule.min) + "_to_" + bound(rule.max),
                          whole_number_type(rule));
      case Form::number:
        return value_type("numbers_in_" + name_part(rule.unit), pattern_type(numbers_pattern(rule.unit)));
    }
    return "xs:string";
  }

  static std::string bound(double value) {
    if (!is_exact(value)) return "any";
    return (value < 0.0 ? "minus_" : "") + std::to_string(std::llabs(std::llround(value)));
  }

  std::string value_type(const std::string& name, const std::string& content) {
    if (value_types_.contains(name)) return name;
    value_types_[name] =
        !options_.has_arguments
            ? named_type(name, content)
            : named_type(name, "<xs:union memberTypes=\"" + std::string(kArgument) + "\"><xs:simpleType>" +
                                   content + "</xs:simpleType></xs:union>");
    return name;
  }

  const FileRules& file_;
  const SchemaOptions& options_;
  std::vector<Pending> pending_;
  std::map<std::string, std::string> value_types_;  // by name
};

}  // namespace

std::string schema(const FileRules& file, const SchemaOptions& options) {
  return Writer(file, options).write();
}

}  // namespace orca::xml
