// SPDX-License-Identifier: LGPL-3.0-or-later
#include "prefix.hpp"

#include "naming.hpp"
#include "orca/graph/process.hpp"
#include "trading/constraint.hpp"

namespace orca::graph {
namespace {

void prefix_name(Node& node, const char* attribute, const std::string& context) {
  const auto found = node.attributes.find(attribute);
  // An empty name is an error, or cancels what another part says.
  if (found == node.attributes.end() || found->second.value.empty()) return;
  found->second.value.insert(0, context);
}

void prefix_names(Node& node, const char* attribute, const std::string& context) {
  const auto found = node.attributes.find(attribute);
  if (found == node.attributes.end()) return;
  std::string result;
  for (const std::string& name : split_names(found->second.value))
    result += (result.empty() ? "" : " ") + context + name;
  found->second.value = result;
}

// "main" is one process, whichever file names it.
void prefix_process(Node& node, const char* attribute, const std::string& context) {
  if (node.value(attribute) != kMainProcess) prefix_name(node, attribute, context);
}

void prefix_component(Node& node, const std::string& context) {
  prefix_name(node, "name", context);
  prefix_name(node, "hardware", context);
  prefix_process(node, "process", context);
  prefix_names(node, "start_after", context);
  prefix_names(node, "may_set", context);
  prefix_names(node, "may_suspend", context);
}

}  // namespace

void put_prefix(Node& node, const std::string& context) {
  node.context.insert(0, context);
  if (node.is("machine")) prefix_name(node, "name", context);
  if (node.is("process")) {
    prefix_process(node, "name", context);
    prefix_name(node, "machine", context);
  }
  if (node.is("hardware") || node.is("component")) prefix_component(node, context);
  if (node.is("group")) {
    prefix_name(node, "name", context);
    prefix_names(node, "components", context);
  }
  if (node.is("connect")) {
    prefix_name(node, "from", context);
    prefix_name(node, "to", context);
  }
  if (node.is("port") && !looks_like_constraint(node.value("candidates")))
    prefix_names(node, "candidates", context);
  for (Node& child : node.children) put_prefix(child, context);
}

}  // namespace orca::graph
