// SPDX-License-Identifier: LGPL-3.0-or-later
#include "structure.hpp"

#include <map>

#include "codes.hpp"
#include "orca/base/text.hpp"
#include "orca/xml/matching.hpp"
#include "orca/xml/names.hpp"
#include "orca/xml/number.hpp"
#include "values.hpp"

namespace orca::graph {
namespace {

std::string tag(std::string_view name) { return "<" + std::string(name) + ">"; }

class Reader {
 public:
  Reader(Arguments& arguments, Report& report) : arguments_(arguments), report_(report) {}

  Structure read_graph(const xml::Element& root) {
    const xml::ElementRule& rule = *graph_rules().find("graph");
    result_.graph = {&rule, root.position(), {}, {}};
    // Arguments first: everything else may use them.
    std::vector<std::pair<const xml::Element*, const xml::ElementRule*>> others;
    for (const xml::Element& child : root.children()) {
      const xml::ElementRule* meant = xml::match_child(child, rule, graph_rules(), report_);
      if (meant != nullptr && meant->name == "arg") {
        arguments_.declare(read(child, *meant));
      } else {
        others.emplace_back(&child, meant);
      }
    }
    read_attributes(root, result_.graph);
    xml::check_text(root, graph_rules(), report_);
    for (const auto& [child, meant] : others) read_child(*child, meant, result_.graph);
    return std::move(result_);
  }

 private:
  Node read(const xml::Element& element, const xml::ElementRule& rule) {
    Node node{&rule, element.position(), {}, {}};
    read_attributes(element, node);
    xml::check_text(element, graph_rules(), report_);
    read_children(element, node);
    drop_duplicates(node);
    if (node.is("component") && node.value("name").empty()) result_.names_incomplete = true;
    if (node.is("connect")) check_ends(node);
    return node;
  }

  // A connection has two ends, and what it seeks can stand for one of them.
  void check_ends(const Node& node) {
    const bool from = node.find("from") != nullptr;
    const bool to = node.find("to") != nullptr;
    const bool seeks = node.find("seek") != nullptr;
    if (from && to && seeks)
      return report_.error(codes::kTrade, node.place("seek"),
                           "<connect>: seek stands for the end that serves; remove that end, or seek");
    if (seeks && (from || to)) return;
    if (!from)
      report_.error(codes::kMissingAttribute, node.position, "<connect> needs the attribute \"from\"");
    if (!to) report_.error(codes::kMissingAttribute, node.position, "<connect> needs the attribute \"to\"");
  }

  void read_attributes(const xml::Element& element, Node& node) {
    for (const auto& [name, attribute] : xml::match_attributes(element, *node.rule, graph_rules(), report_))
      node.attributes.emplace(name, arguments_.replaced(*attribute));
  }

  void read_children(const xml::Element& element, Node& parent) {
    for (const xml::Element& child : element.children())
      read_child(child, xml::match_child(child, *parent.rule, graph_rules(), report_), parent);
  }

  // @param rule  the rule that was probably meant; null: unknown
  void read_child(const xml::Element& element, const xml::ElementRule* rule, Node& parent) {
    if (rule == nullptr) return excuse(element);
    parent.children.push_back(read(element, *rule));
  }

  void excuse(const xml::Element& element) {
    if (const xml::Attribute* name = element.attribute("name")) result_.excused.insert(name->value);
    for (const xml::Element& child : element.children()) excuse(child);
  }

  // Returns whether the node is a setting: it may stand once inside an element, under its name.
  static bool is_setting(const Node& node) {
    return node.is("param") || node.is("property") || node.is("port") || node.is("arg");
  }

  void drop_duplicates(Node& node) {
    std::map<std::pair<std::string_view, std::string>, xml::Position> seen;
    std::erase_if(node.children, [&](Node& child) {
      const Text* name = child.known("name");
      if (name == nullptr || !is_setting(child)) return false;
      const auto [first, fresh] = seen.try_emplace({child.rule->name, name->value}, child.position);
      if (fresh) return false;
      report_.error(codes::kDuplicateName, name->position,
                    child.title() + " is given already at " + first->second.text());
      child.duplicate = true;
      return !child.is("port");  // connections may use the name that it gives
    });
  }

  Arguments& arguments_;
  Report& report_;
  Structure result_;
};

bool check_root(const xml::Element& root, Report& report) {
  if (root.name() == "graph") return true;
  const std::vector<std::string> expected{"graph"};
  const auto near = xml::nearest_name(root.name(), expected);
  report.error(codes::kWrongRoot, root.position(),
               "the root element is " + tag(root.name()) + ", a system graph starts with <graph>" +
                   xml::did_you_mean(near));
  return near.has_value();
}

void check_version(const Node& graph, Report& report) {
  const Text* version = graph.known("version");
  if (version == nullptr || xml::trimmed(version->value) == "1") return;
  report.error(codes::kVersion, version->position,
               "the graph has version " + in_quotes(version->value) + ", this Orca reads version \"1\"");
}

}  // namespace

std::optional<Structure> read_structure(const xml::Document& document, Arguments& arguments, Report& report) {
  if (!check_root(document.root, report)) return std::nullopt;
  Structure structure = Reader(arguments, report).read_graph(document.root);
  check_version(structure.graph, report);
  check_name(structure.graph, "name", report);
  arguments.check_use();
  return structure;
}

}  // namespace orca::graph
