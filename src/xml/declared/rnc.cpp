// SPDX-License-Identifier: LGPL-3.0-or-later
// The language of Emacs's nxml-mode: RELAX NG in its compact syntax, with the data types of XML Schema. The names of its patterns
// begin with "element." or "value.", so that none is a keyword. It cannot say that names must differ.
#include <algorithm>
#include <cmath>

#include "schema_model.hpp"

namespace orca::xml {
namespace {

std::string comments(const std::string& text, const std::string& indent) {
  std::string lines;
  for (std::size_t start = 0; start < text.size();) {
    const std::size_t end = std::min(text.find('\n', start), text.size());
    lines += indent + "## " + text.substr(start, end - start) + "\n";
    start = end + 1;
  }
  return lines;
}

// Returns a literal, which knows no escapes. No word holds both quotes.
std::string literal(const std::string& text) {
  const char* quote = text.find('"') == std::string::npos ? "\"" : "'";
  return quote + text + quote;
}

std::string value_line(const std::string& name, const SchemaValue& value, bool has_arguments) {
  std::string text = "value." + name + " = ";
  if (has_arguments) text += "value." + std::string(kArgument) + " | ";
  if (!value.pattern.empty()) return text + "xsd:string { pattern = " + literal(value.pattern) + " }\n";
  std::string facets;
  if (is_exact(value.min)) facets += " minInclusive = \"" + std::to_string(std::llround(value.min)) + "\"";
  if (is_exact(value.max)) facets += " maxInclusive = \"" + std::to_string(std::llround(value.max)) + "\"";
  return text + "xsd:integer" + (facets.empty() ? "" : " {" + facets + " }") + "\n";
}

std::string attribute_pattern(const SchemaAttribute& attribute) {
  std::vector<std::string> choices;
  for (const SchemaWord& one : attribute.words)
    choices.push_back("\n" + comments(one.text, "    ") + "    " + literal(one.word));
  if (!attribute.value.empty())
    choices.push_back(attribute.value == kAnyText ? "text" : "value." + attribute.value);
  std::string values;
  for (const std::string& choice : choices)
    values += values.empty() ? choice : (choice.starts_with('\n') ? " |" : " | ") + choice;
  if (!values.starts_with('\n')) values.insert(0, 1, ' ');
  return comments(attribute.text, "  ") + "  attribute " + attribute.name + " {" +
         (choices.empty() ? " notAllowed" : values) + " }" + (attribute.required ? "" : "?");
}

// Returns the further attributes of an open type: all but its own.
std::string other_attributes(const SchemaType& type) {
  std::string own;
  for (const SchemaAttribute& attribute : type.attributes) own += (own.empty() ? "" : " | ") + attribute.name;
  return "  attribute *" + (own.empty() ? "" : " - (" + own + ")") + " { text }*";
}

std::string type_pattern(const SchemaType& type, const std::vector<std::string>& others) {
  std::string children;
  for (const SchemaChild& child : type.children)
    children += (children.empty() ? "  (" : "\n   | ") + ("element " + child.name) + " { element." +
                child.type + " }";
  if (type.is_open)
    for (const std::string& other : others)
      children += (children.empty() ? "  (" : "\n   | ") + ("element " + other) + " { anything }";
  std::vector<std::string> parts;
  for (const SchemaAttribute& attribute : type.attributes) parts.push_back(attribute_pattern(attribute));
  if (type.is_open)
    parts.push_back(other_attributes(type));
  else
    for (const std::string& name : type.foreign) parts.push_back("  attribute " + name + " { text }?");
  if (!children.empty()) parts.push_back(children + ")*");
  std::string content;
  for (const std::string& part : parts) content += (content.empty() ? "\n" : ",\n") + part;
  return comments(type.text, "") + "element." + type.name + " =" + (content.empty() ? " empty" : content) +
         "\n";
}

}  // namespace

std::string rnc(const SchemaModel& model, const std::string& title) {
  std::string roots;
  for (const SchemaChild& root : model.roots)
    roots += (roots.empty() ? "" : " | ") + ("element " + root.name) + " { element." + root.type + " }";
  std::string text = "# SPDX-License-Identifier: LGPL-3.0-or-later\n# " + title +
                     ", for editors. Written by Orca from the rules that it reads by\n" +
                     "namespace xsi = \"http://www.w3.org/2001/XMLSchema-instance\"\nstart = " + roots + "\n";
  for (const SchemaType& type : model.types) text += type_pattern(type, model.others);
  if (model.has_arguments)
    text +=
        "value." + std::string(kArgument) + " = xsd:string { pattern = " + literal(kArgumentPattern) + " }\n";
  for (const auto& [name, value] : model.values) text += value_line(name, value, model.has_arguments);
  if (!model.others.empty()) text += "anything = (element * { anything } | attribute * { text } | text)*\n";
  return text;
}

}  // namespace orca::xml
