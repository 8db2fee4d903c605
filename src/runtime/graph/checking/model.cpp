// SPDX-License-Identifier: LGPL-3.0-or-later
#include "model.hpp"

#include "orca/base/text.hpp"
#include "reading/codes.hpp"

namespace orca::graph {

bool check_component_exists(const std::string& name, const xml::Position& place, const std::string& title,
                            const Model& model, Report& report) {
  if (model.component(name) != nullptr) return true;
  if (model.excused.contains(name)) return false;
  const std::string hint = report.hint_in_contexts(name, model.component_names);
  if (model.names_incomplete && hint.empty()) return false;
  report.error(codes::kUnknownComponent, place,
               title + ": there is no component " + in_quotes(name) +
                   (hint.empty() ? "; the graph has: " + listed(model.component_names) : hint));
  return false;
}

}  // namespace orca::graph
