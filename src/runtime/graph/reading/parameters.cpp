// SPDX-License-Identifier: LGPL-3.0-or-later
#include "parameters.hpp"

#include "codes.hpp"
#include "orca/base/text.hpp"
#include "values.hpp"

namespace orca::graph {
namespace {

void report_unknown(const Node& node, const Node& param, const Contract& contract, Report& report) {
  std::vector<std::string> names;
  for (const ParamContract& known : contract.params) names.push_back(known.name);
  const std::string name = param.value("name");
  report.error(codes::kUnknownParameter, param.place("name"),
               node.title() + ": there is no parameter " + in_quotes(name) + "; " + contract.type +
                   " has: " + listed(names) + report.hint(name, names));
}

// Returns false if the parameter cannot be used.
bool read_param(const Node& node, const Node& param, const Contract& contract, Params& result,
                Report& report) {
  const Text* value = param.known("value");
  if (param.known("name") == nullptr || value == nullptr) return false;
  const std::string name = param.value("name");
  const ParamContract* declared = contract.param(name);
  if (declared == nullptr) {
    report_unknown(node, param, contract, report);
    return false;
  }
  auto read = read_value(*value, *declared, node.title() + ": parameter " + in_quotes(name), report);
  if (read) result[name] = std::move(*read);
  return read.has_value();
}

}  // namespace

std::optional<Params> read_params(const Node& node, const Contract& contract, Report& report) {
  Params result;
  for (const ParamContract& declared : contract.params) result[declared.name] = declared.default_value;
  bool sound = true;
  for (const Node& child : node.children) {
    if (child.is("param")) sound = read_param(node, child, contract, result, report) && sound;
  }
  return sound ? std::optional(std::move(result)) : std::nullopt;
}

}  // namespace orca::graph
