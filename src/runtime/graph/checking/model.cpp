// SPDX-License-Identifier: LGPL-3.0-or-later
#include "model.hpp"

#include "orca/base/text.hpp"
#include "reading/codes.hpp"

namespace orca::graph {
namespace {

// Returns the end of a message about a part that stands in a profile which is not chosen; nothing if it does not.
std::string profile_hint(const std::string& kind, const std::string& name, const Model& model) {
  const auto found = model.left_out.find({kind, name});
  if (found == model.left_out.end() || model.parts_missing) return {};
  const std::vector<std::string> profiles(found->second.begin(), found->second.end());
  return "; it stands in the profile " + joined(profiles, " or ") +
         ", which is not chosen: write --profile " + profiles.back() + ", or default_profile=\"" +
         profiles.back() + "\" in <graph>";
}

}  // namespace

void report_unknown(const Node& node, const Text& name, const char* code, const std::string& kind,
                    const std::vector<std::string>& names, const std::string& remedy, const Model& model,
                    Report& report) {
  if (model.excused.contains(name.value)) return;
  std::string hint = profile_hint(kind, name.value, model);
  if (hint.empty()) hint = report.hint_in_contexts(name.value, names);
  if (model.parts_missing && hint.empty()) return;
  report.error(code, name.position,
               node.title() + ": there is no " + kind + " " + in_quotes(name.value) +
                   "; the graph has: " + listed(names) + (hint.empty() ? remedy : hint));
}

bool check_component_exists(const std::string& name, const xml::Position& place, const std::string& title,
                            const Model& model, Report& report) {
  if (model.component(name) != nullptr) return true;
  if (model.excused.contains(name)) return false;
  std::string hint = profile_hint("component", name, model);
  if (hint.empty()) hint = report.hint_in_contexts(name, model.component_names);
  if (model.names_incomplete && hint.empty()) return false;
  report.error(codes::kUnknownComponent, place,
               title + ": there is no component " + in_quotes(name) +
                   (hint.empty() ? "; the graph has: " + listed(model.component_names) : hint));
  return false;
}

}  // namespace orca::graph
