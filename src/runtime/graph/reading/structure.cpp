// SPDX-License-Identifier: LGPL-3.0-or-later
#include "structure.hpp"

#include <map>

#include "codes.hpp"
#include "node_name.hpp"
#include "orca/xml/names.hpp"
#include "orca/xml/number.hpp"

namespace orca::graph {
namespace {

std::string tag(std::string_view name) { return "<" + std::string(name) + ">"; }

// At most so many bytes, and no character cut in two.
std::string beginning_of(std::string_view text, std::size_t length) {
  while (length > 0 && (static_cast<unsigned char>(text[length]) & 0xC0U) == 0x80U) --length;
  return std::string(text.substr(0, length));
}

class Reader {
 public:
  Reader(Arguments& arguments, Report& report) : arguments_(arguments), report_(report) {}

  Structure read_graph(const xml::Element& root) {
    const ElementRule& rule = *find_rule("graph");
    result_.graph = {&rule, root.position(), {}, {}};
    // Arguments first: everything else may use them.
    const ElementRule* const arg = find_rule("arg");
    std::vector<std::pair<const xml::Element*, const ElementRule*>> others;
    for (const xml::Element& child : root.children()) {
      const ElementRule* meant = rule.guess_child(child);
      if (meant == arg) {
        read_argument(child, rule, *arg);
      } else {
        others.emplace_back(&child, meant);
      }
    }
    read_attributes(root, result_.graph);
    check_text(root);
    for (const auto& [child, meant] : others) read_child(*child, meant, result_.graph);
    return std::move(result_);
  }

 private:
  void read_argument(const xml::Element& element, const ElementRule& parent, const ElementRule& rule) {
    check_spelling(element, parent, &rule);
    arguments_.declare(read(element, rule));
  }

  Node read(const xml::Element& element, const ElementRule& rule) {
    Node node{&rule, element.position(), {}, {}};
    read_attributes(element, node);
    check_text(element);
    read_children(element, node);
    drop_duplicates(node);
    if (node.is("component") && node.value("name").empty()) result_.names_incomplete = true;
    return node;
  }

  void read_attributes(const xml::Element& element, Node& node) {
    for (const xml::Attribute& attribute : element.attributes()) {
      if (node.is("graph") && leads_to_schema(attribute)) continue;
      const std::string name = attribute_meant(element, attribute, *node.rule);
      if (!name.empty()) node.attributes.emplace(name, arguments_.replaced(attribute));
    }
    for (const AttributeRule& rule : node.rule->attributes) {
      if (!rule.required || node.find(rule.name) != nullptr) continue;
      report_.error(codes::kMissingAttribute, element.position(),
                    tag(element.name()) + " needs the attribute " + in_quotes(rule.name));
    }
  }

  // How editors find graphs/orca-graph.xsd.
  static bool leads_to_schema(const xml::Attribute& attribute) {
    return attribute.name == "xmlns:xsi" || attribute.name == "xsi:noNamespaceSchemaLocation";
  }

  // The attribute's name; for an unknown one the one it was meant to be, if that is not there as well.
  std::string attribute_meant(const xml::Element& element, const xml::Attribute& attribute,
                              const ElementRule& rule) {
    if (rule.attribute(attribute.name) != nullptr) return attribute.name;
    const std::vector<std::string> names = rule.attribute_names();
    const auto near = report_.nearest(attribute.name, names);
    report_.error(codes::kUnknownAttribute, attribute.position,
                  tag(element.name()) + " has no attribute " + in_quotes(attribute.name) +
                      "; it has: " + xml::listed(names) + xml::did_you_mean(near));
    return near && element.attribute(*near) == nullptr ? *near : "";
  }

  void check_text(const xml::Element& element) {
    const std::string_view text = xml::trimmed(element.text());
    if (text.empty()) return;
    const std::string shown = text.size() > 20 ? beginning_of(text, 20) + "..." : std::string(text);
    report_.error(codes::kStrayText, element.text_position(),
                  "the text " + in_quotes(shown) + " inside " + tag(element.name()) +
                      " means nothing; a graph says everything in attributes");
  }

  void read_children(const xml::Element& element, Node& parent) {
    for (const xml::Element& child : element.children()) {
      read_child(child, parent.rule->guess_child(child), parent);
    }
  }

  // @param rule  what the element was meant to be; null: there is no telling
  void read_child(const xml::Element& element, const ElementRule* rule, Node& parent) {
    check_spelling(element, *parent.rule, rule);
    if (rule == nullptr) return excuse(element);
    if (rule->support == ElementRule::Support::full) {
      parent.children.push_back(read(element, *rule));
    } else {
      read_unsupported(element, *rule, parent);
    }
  }

  void read_unsupported(const xml::Element& element, const ElementRule& rule, Node& parent) {
    report_.error(codes::kUnsupported, element.position(),
                  tag(rule.name) + " is not supported yet; put what it contains directly into the graph");
    Node inside{&rule, element.position(), {}, {}};
    read_children(element, inside);
    for (Node& child : inside.children) parent.children.push_back(std::move(child));
  }

  void check_spelling(const xml::Element& element, const ElementRule& parent, const ElementRule* meant) {
    if (meant != nullptr && meant->name == element.name()) return;
    if (find_rule(element.name()) != nullptr) {
      return report_.error(codes::kMisplacedElement, element.position(),
                           tag(element.name()) + " does not belong in " + tag(parent.name) +
                               (element.name() == "graph" ? "; it is the root of the file"
                                                          : "; it goes into " + parents_of(element.name())));
    }
    const auto near = meant == nullptr ? std::nullopt : std::optional(std::string(meant->name));
    const std::vector<std::string> allowed = parent.child_names();
    report_.error(codes::kUnknownElement, element.position(),
                  "there is no element " + tag(element.name()) + " in " + tag(parent.name) +
                      "; it may contain: " + xml::listed(allowed) + xml::did_you_mean(near));
  }

  void excuse(const xml::Element& element) {
    if (const xml::Attribute* name = element.attribute("name")) result_.excused.insert(name->value);
    for (const xml::Element& child : element.children()) excuse(child);
  }

  // What may be said once inside an element, under its name.
  static bool is_setting(const Node& node) {
    return node.is("param") || node.is("property") || node.is("port") || node.is("arg");
  }

  void drop_duplicates(Node& node) {
    std::map<std::pair<std::string_view, std::string>, xml::Position> seen;
    std::erase_if(node.children, [&](const Node& child) {
      const Text* name = child.known("name");
      if (name == nullptr || !is_setting(child)) return false;
      const auto [first, fresh] = seen.try_emplace({child.rule->name, name->value}, child.position);
      if (fresh) return false;
      report_.error(codes::kDuplicateName, name->position,
                    child.title() + " is given already at " + first->second.text());
      return true;
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
