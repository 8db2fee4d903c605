// SPDX-License-Identifier: GPL-3.0-or-later
// The schema of graphs: what it allows fits the reader's rules, and which faults it finds.
#include "orca/graph/print.hpp"

#include <algorithm>
#include <iostream>
#include <iterator>
#include <map>

#include "approval.hpp"
#include "fake_catalogue.hpp"
#include "loading.hpp"
#include "orca/xml/document.hpp"
#include "reading/rules.hpp"
#include "temp_folder.hpp"

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
  const auto document = xml::read_text(graph::schema({}), "orca-graph.xsd", diagnostics);
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

std::vector<Contract> fake_contracts() {
  FakeCatalogue catalogue;
  std::vector<Contract> contracts;
  for (const std::string& type : catalogue.type_names(PluginKind::component))
    contracts.push_back(*catalogue.component(type, nullptr));
  for (const std::string& type : catalogue.type_names(PluginKind::hardware))
    contracts.push_back(*catalogue.hardware(type));
  return contracts;
}

bool has_tool(const std::string& name, const std::string& package) {
  if (std::system(("command -v " + name + " >/dev/null").c_str()) == 0) return true;
  std::cout << "SKIPPED: there is no " + name + "; apt install " + package + "\n";
  return false;
}

bool has_xmllint() { return has_tool("xmllint", "libxml2-utils"); }

// The files that do not fit the schema, as xmllint finds.
// @param option  says the schema's language.
std::vector<std::string> misfits(const std::string& option, const std::string& schema,
                                 const std::vector<fs::path>& files) {
  std::vector<std::string> names;
  for (const fs::path& file : files)
    if (std::system(
            ("xmllint --noout " + option + " '" + schema + "' '" + file.string() + "' 2>/dev/null >&2")
                .c_str()) != 0)
      names.push_back(file.filename().string());
  return names;
}

// Writes the schema in the compact syntax of RELAX NG, and again in its XML syntax, which xmllint reads.
std::string relax_ng(const orca::test::TempFolder& folder) {
  const std::string compact =
      folder.write("graph.rnc", graph::schema(fake_contracts(), xml::SchemaLanguage::rnc));
  const std::string converted = compact + ".rng";
  REQUIRE(std::system(("rnc2rng '" + compact + "' '" + converted + "'").c_str()) == 0);
  return converted;
}

std::vector<fs::path> good_graphs() {
  return orca::test::files_in(fs::path(ORCA_SOURCE_DIR) / "tests/data/graphs/good", ".xml");
}

std::vector<fs::path> faulty_graphs() {
  std::vector<fs::path> faulty;
  for (const fs::path& file :
       orca::test::files_in(fs::path(ORCA_SOURCE_DIR) / "tests/data/graphs/broken", ".xml"))
    if (orca::test::bytes_of(orca::test::approved_text_of(file)).find(": error ") != std::string::npos)
      faulty.push_back(file);
  return faulty;
}

}  // namespace

TEST_CASE("docs/graph.md and its parts have every attribute of the schema, with its words",
          "[graph][schema][docs]") {
  std::string page;
  for (const char* part : {"graph", "graph-parts", "connections", "graph-processes"})
    page += orca::test::bytes_of(fs::path(ORCA_SOURCE_DIR) / "docs" / (std::string(part) + ".md"));
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
  CHECK(said_about("<?xml version='1.0'?>\n<?xml-model href='orca-graph.xsd'?>\n<graph name='g'/>").empty());
}

TEST_CASE("xmllint finds no fault in good graphs by a schema with types", "[graph][schema][tool]") {
  if (!has_xmllint()) return;
  const orca::test::TempFolder folder;
  const std::string schema = folder.write("graph.xsd", graph::schema(fake_contracts()));
  CHECK(misfits("--schema", schema, good_graphs()) == std::vector<std::string>{});
  if (!has_tool("rnc2rng", "python3-rnc2rng")) return;
  std::vector<fs::path> files = good_graphs();
  files.emplace_back(folder.write("leading.xml",
                                  "<graph name='g' xmlns:xsi='http://www.w3.org/2001/XMLSchema-instance' "
                                  "xsi:noNamespaceSchemaLocation='orca-graph.xsd'/>"));
  CHECK(misfits("--relaxng", relax_ng(folder), files) == std::vector<std::string>{});
}

// As docs/graph.md says.
TEST_CASE("xmllint finds at least 99 of the faulty graphs by a schema with types", "[graph][schema][tool]") {
  if (!has_xmllint()) return;
  const orca::test::TempFolder folder;
  const std::string schema = folder.write("graph.xsd", graph::schema(fake_contracts()));
  const std::vector<fs::path> faulty = faulty_graphs();
  const std::vector<std::string> found = misfits("--schema", schema, faulty);
  std::cout << found.size() << " of " << faulty.size() << " faulty graphs do not fit the schema\n";
  CHECK(found.size() >= 99);
  if (!has_tool("rnc2rng", "python3-rnc2rng")) return;

  // RELAX NG finds the same, except names that are given twice.
  const std::vector<std::string> found_in_emacs = misfits("--relaxng", relax_ng(folder), faulty);
  std::vector<std::string> missed;
  std::ranges::set_difference(found, found_in_emacs, std::back_inserter(missed));
  CHECK(missed == std::vector<std::string>{"arg_duplicate.xml", "machine_duplicate.xml",
                                           "name_duplicate_component.xml", "name_duplicate_hardware.xml",
                                           "name_duplicate_param.xml", "port_given_twice_and_used.xml",
                                           "port_set_twice.xml", "process_duplicate.xml"});
  std::vector<std::string> more;
  std::ranges::set_difference(found_in_emacs, found, std::back_inserter(more));
  CHECK(more == std::vector<std::string>{});
}
