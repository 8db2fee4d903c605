// SPDX-License-Identifier: LGPL-3.0-or-later
#include "node_name.hpp"

#include <string>

#include "codes.hpp"
#include "naming.hpp"
#include "orca/base/text.hpp"

namespace orca::graph {

void check_name(const Node& node, const char* attribute, Report& report) {
  const Text* name = node.known(attribute);
  if (name == nullptr) return;
  const auto fault = name_fault(name->value);
  if (fault && !report.tolerates(name->value)) {
    report.error(codes::kBadName, name->position,
                 "the " + std::string(attribute) + " " + in_quotes(name->value) + " of a " +
                     std::string(node.rule->name) + ": " + *fault);
  }
}

}  // namespace orca::graph
