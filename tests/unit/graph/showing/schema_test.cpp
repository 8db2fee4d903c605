// SPDX-License-Identifier: GPL-3.0-or-later
// graphs/orca-graph.xsd is the output of --schema, and all graphs of the repository fit it.
#include "orca/graph/print.hpp"

#include <map>
#include <set>

#include "approval.hpp"
#include "loading.hpp"
#include "orca/xml/document.hpp"
#include "reading/rules.hpp"

namespace fs = std::filesystem;
using namespace orca;

namespace {

// The part of the XML schema language that orca-graph.xsd uses: types with children and attributes.
struct Type {
  std::map<std::string, std::string> children;  // element to type
  std::map<std::string, bool> attributes;       // required?
};

std::string attribute(const xml::Element& element, const char* name) {
  const xml::Attribute* found = element.attribute(name);
  return found == nullptr ? "" : found->value;
}

std::map<std::string, Type> types_of_schema() {
  xml::Diagnostics diagnostics;
  const auto document = xml::read_text(graph::schema(), "orca-graph.xsd", diagnostics);
  INFO(diagnostics.text());
  REQUIRE(document.has_value());
  CHECK_FALSE(diagnostics.has_errors());
  std::map<std::string, Type> types;
  for (const xml::Element& type : document->root.children()) {
    if (type.name() != "xs:complexType") continue;
    Type& read = types[attribute(type, "name")];
    for (const xml::Element& part : type.children()) {
      if (part.name() == "xs:attribute")
        read.attributes[attribute(part, "name")] = attribute(part, "use") == "required";
      if (part.name() != "xs:choice") continue;
      for (const xml::Element& child : part.children())
        read.children[attribute(child, "name")] = attribute(child, "type");
    }
  }
  return types;
}

void check_fits(const xml::Element& element, const std::string& type_name,
                const std::map<std::string, Type>& types) {
  INFO(element.position().text() << ": <" << element.name() << ">");
  REQUIRE(types.contains(type_name));
  const Type& type = types.at(type_name);
  for (const xml::Attribute& found : element.attributes()) {
    INFO(found.name);
    CHECK(type.attributes.contains(found.name));
  }
  for (const auto& [name, required] : type.attributes) {
    INFO(name);
    CHECK((!required || element.attribute(name) != nullptr));
  }
  for (const xml::Element& child : element.children()) {
    INFO("<" << child.name() << ">");
    REQUIRE(type.children.contains(child.name()));
    check_fits(child, type.children.at(child.name()), types);
  }
}

}  // namespace

TEST_CASE("graphs/orca-graph.xsd is the schema that the rules give", "[graph][schema]") {
  orca::test::check_approved(fs::path(ORCA_SOURCE_DIR) / "graphs/orca-graph.xsd", graph::schema());
}

TEST_CASE("docs/graph.md has every attribute of the schema, with its words", "[graph][schema][docs]") {
  const std::string page = orca::test::bytes_of(fs::path(ORCA_SOURCE_DIR) / "docs/graph.md");
  for (const xml::ElementRule* element : graph::graph_rules().elements) {
    if (element->name == "param" || element->name == "property") continue;  // explained in a sentence
    for (const xml::AttributeRule& rule : element->attributes) {
      const std::string row = "| `" + std::string(rule.name) + "` | " + (rule.required ? "yes" : "") + " | " +
                              std::string(rule.text);
      INFO(row);
      CHECK(page.find(row) != std::string::npos);
    }
  }
}

TEST_CASE("every type that the schema names is there", "[graph][schema]") {
  const auto types = types_of_schema();
  for (const auto& [name, type] : types)
    for (const auto& [child, child_type] : type.children) CHECK(types.contains(child_type));
}

TEST_CASE("the shipped graphs and those of the tests fit the schema", "[graph][schema]") {
  const auto types = types_of_schema();
  std::size_t checked = 0;
  for (const char* folder : {"graphs", "tests/data/graphs/good", "tests/data/graphs/system"}) {
    for (const fs::path& file : orca::test::files_in(fs::path(ORCA_SOURCE_DIR) / folder, ".xml")) {
      xml::Diagnostics diagnostics;
      const auto document = xml::read_file(file.string(), diagnostics);
      REQUIRE(document.has_value());
      check_fits(document->root, "graph", types);
      ++checked;
    }
  }
  CHECK(checked >= 8);
}

TEST_CASE("a graph may lead editors to the schema", "[graph][schema]") {
  CHECK(said_about("<graph name='g' xmlns:xsi='http://www.w3.org/2001/XMLSchema-instance' "
                   "xsi:noNamespaceSchemaLocation='orca-graph.xsd'/>")
            .empty());
}
