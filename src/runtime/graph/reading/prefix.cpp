// SPDX-License-Identifier: LGPL-3.0-or-later
#include "prefix.hpp"

#include "naming.hpp"

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

}  // namespace

void put_prefix(Node& node, const std::string& context) {
  if (node.is("hardware") || node.is("component")) prefix_name(node, "name", context);
  if (node.is("component")) {
    prefix_name(node, "hardware", context);
    prefix_names(node, "start_after", context);
  }
  if (node.is("connect")) {
    prefix_name(node, "from", context);
    prefix_name(node, "to", context);
  }
  if (node.is("port")) prefix_names(node, "candidates", context);
  for (Node& child : node.children) put_prefix(child, context);
}

}  // namespace orca::graph
