// SPDX-License-Identifier: LGPL-3.0-or-later
#include "orca/graph/print.hpp"

#include "orca/xml/document.hpp"
#include "reading/rules.hpp"

namespace orca::graph {
namespace {

using xml::AttributeRule;
using xml::ElementRule;

std::string documentation(std::string_view text, const std::string& indent) {
  if (text.empty()) return {};
  return indent + "<xs:annotation><xs:documentation>" + xml::escaped(text) +
         "</xs:documentation></xs:annotation>\n";
}

// Returns a type that allows one of the words, or a text that contains an argument.
std::string choices_text(std::span<const std::string_view> choices) {
  std::string text =
      "      <xs:simpleType>\n        <xs:union memberTypes=\"with_argument\">\n          <xs:simpleType>\n"
      "            <xs:restriction base=\"xs:string\">\n";
  for (const std::string_view choice : choices)
    text += "              <xs:enumeration value=\"" + std::string(choice) + "\"/>\n";
  return text +
         "            </xs:restriction>\n          </xs:simpleType>\n        </xs:union>\n"
         "      </xs:simpleType>\n";
}

std::string attribute_text(const AttributeRule& rule) {
  std::string start = "    <xs:attribute name=\"" + std::string(rule.name) + "\"";
  if (rule.value.choices.empty()) start += " type=\"xs:string\"";
  if (rule.required) start += " use=\"required\"";
  const std::string content = documentation(rule.text, "      ") +
                              (rule.value.choices.empty() ? "" : choices_text(rule.value.choices));
  return content.empty() ? start + "/>\n" : start + ">\n" + content + "    </xs:attribute>\n";
}

std::string children_text(const ElementRule& rule) {
  std::string text;
  for (const ElementRule* child : rule.children) {
    const std::string name(child->name);
    text += "      <xs:element name=\"" + name + "\" type=\"" + (brings_file(rule) ? "given_" : "") + name +
            "\"/>\n";
  }
  if (text.empty()) return {};
  return "    <xs:choice minOccurs=\"0\" maxOccurs=\"unbounded\">\n" + text + "    </xs:choice>\n";
}

std::string type_text(const std::string& name, const ElementRule& rule) {
  std::string text =
      "  <xs:complexType name=\"" + name + "\">\n" + documentation(rule.text, "    ") + children_text(rule);
  for (const AttributeRule& attribute : rule.attributes) text += attribute_text(attribute);
  return text + "  </xs:complexType>\n";
}

}  // namespace

std::string schema() {
  std::string text =
      "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
      "<!-- SPDX-License-Identifier: LGPL-3.0-or-later -->\n"
      "<!-- Orca's system graphs, for editors. Written by the deployer from the rules that it reads by -->\n"
      "<xs:schema xmlns:xs=\"http://www.w3.org/2001/XMLSchema\">\n"
      "  <xs:simpleType name=\"with_argument\">\n"
      "    <xs:restriction base=\"xs:string\"><xs:pattern value=\".*[$]\\{.*\\}.*\"/></xs:restriction>\n"
      "  </xs:simpleType>\n"
      "  <xs:element name=\"graph\" type=\"graph\"/>\n";
  for (const ElementRule* rule : graph_rules().elements) text += type_text(std::string(rule->name), *rule);
  return text + type_text("given_arg", *graph_rules().find("include")->child("arg")) + "</xs:schema>\n";
}

}  // namespace orca::graph
