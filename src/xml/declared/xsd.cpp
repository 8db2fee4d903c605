// SPDX-License-Identifier: LGPL-3.0-or-later
// The language of VS Code's editor and of xmllint: XML Schema 1.0.
#include <algorithm>
#include <cmath>

#include "orca/xml/document.hpp"
#include "schema_model.hpp"

namespace orca::xml {
namespace {

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

std::string pattern_type(const std::string& pattern) {
  return "<xs:restriction base=\"xs:string\"><xs:pattern value=\"" + pattern + "\"/></xs:restriction>";
}

std::string whole_number_type(const SchemaValue& value) {
  std::string facets;
  if (is_exact(value.min))
    facets += "<xs:minInclusive value=\"" + std::to_string(std::llround(value.min)) + "\"/>";
  if (is_exact(value.max))
    facets += "<xs:maxInclusive value=\"" + std::to_string(std::llround(value.max)) + "\"/>";
  return "<xs:restriction base=\"xs:integer\">" + facets + "</xs:restriction>";
}

std::string named_type(const std::string& name, const std::string& content) {
  return "  <xs:simpleType name=\"" + name + "\">\n    " + content + "\n  </xs:simpleType>\n";
}

std::string value_text(const std::string& name, const SchemaValue& value, bool has_arguments) {
  const std::string content = value.pattern.empty() ? whole_number_type(value) : pattern_type(value.pattern);
  if (!has_arguments) return named_type(name, content);
  return named_type(name, "<xs:union memberTypes=\"" + std::string(kArgument) + "\"><xs:simpleType>" +
                              content + "</xs:simpleType></xs:union>");
}

// Returns how the schema calls a type of values.
std::string reference(const std::string& value) { return value == kAnyText ? "xs:string" : value; }

std::string element_text(const SchemaChild& child, const std::string& indent) {
  const std::string start = indent + "<xs:element name=\"" + child.name + "\" type=\"" + child.type + "\"";
  std::string content;
  for (const auto& [name, children] : child.unique)
    content += indent + "  <xs:unique name=\"" + name + "\"><xs:selector xpath=\"" + children +
               "\"/><xs:field xpath=\"@name\"/></xs:unique>\n";
  return content.empty() ? start + "/>\n" : start + ">\n" + content + indent + "</xs:element>\n";
}

// Returns a type that allows one of the words, or what the other type allows.
std::string words_text(const SchemaAttribute& attribute) {
  std::string enumeration = "<xs:restriction base=\"xs:string\">\n";
  for (const SchemaWord& one : attribute.words) {
    enumeration += "              <xs:enumeration value=\"" + escaped(one.word) + "\"";
    enumeration += one.text.empty() ? "/>\n"
                                    : ">\n" + documentation(one.text, "                ") +
                                          "              </xs:enumeration>\n";
  }
  enumeration += "            </xs:restriction>\n";
  return "      <xs:simpleType>\n        <xs:union" +
         (attribute.value.empty() ? "" : " memberTypes=\"" + reference(attribute.value) + "\"") +
         ">\n          <xs:simpleType>\n            " + enumeration +
         "          </xs:simpleType>\n        </xs:union>\n      </xs:simpleType>\n";
}

std::string attribute_text(const SchemaAttribute& attribute) {
  std::string start = "    <xs:attribute name=\"" + attribute.name + "\"";
  std::string content = documentation(attribute.text, "      ");
  if (attribute.words.empty() && !attribute.value.empty())
    start += " type=\"" + reference(attribute.value) + "\"";
  else
    content += words_text(attribute);
  if (attribute.required) start += " use=\"required\"";
  return content.empty() ? start + "/>\n" : start + ">\n" + content + "    </xs:attribute>\n";
}

std::string type_text(const SchemaType& type, const std::vector<std::string>& others) {
  std::string children;
  for (const SchemaChild& child : type.children) children += element_text(child, "      ");
  if (type.is_open)
    for (const std::string& other : others) children += "      <xs:element name=\"" + other + "\"/>\n";
  std::string text = "  <xs:complexType name=\"" + type.name + "\">\n" + documentation(type.text, "    ");
  if (!children.empty())
    text += "    <xs:choice minOccurs=\"0\" maxOccurs=\"unbounded\">\n" + children + "    </xs:choice>\n";
  for (const SchemaAttribute& attribute : type.attributes) text += attribute_text(attribute);
  if (type.is_open) text += "    <xs:anyAttribute processContents=\"skip\"/>\n";
  return text + "  </xs:complexType>\n";
}

}  // namespace

std::string xsd(const SchemaModel& model, const std::string& title) {
  std::string text =
      "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
      "<!-- SPDX-License-Identifier: LGPL-3.0-or-later -->\n<!-- " +
      title +
      ", for editors. Written by Orca from the rules that it reads by -->\n"
      "<xs:schema xmlns:xs=\"http://www.w3.org/2001/XMLSchema\">\n";
  if (model.has_arguments) text += named_type(kArgument, pattern_type(kArgumentPattern));
  for (const auto& [name, value] : model.values) text += value_text(name, value, model.has_arguments);
  for (const SchemaChild& root : model.roots) text += element_text(root, "  ");
  for (const SchemaType& type : model.types) text += type_text(type, model.others);
  return text + "</xs:schema>\n";
}

}  // namespace orca::xml
