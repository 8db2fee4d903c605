// SPDX-License-Identifier: LGPL-3.0-or-later
#include "parameters.hpp"

#include <algorithm>

#include "codes.hpp"
#include "orca/graph/loader.hpp"
#include "orca/xml/names.hpp"
#include "values.hpp"

namespace orca::graph {
namespace {

void report_unknown(const Node& node, const Node& param, const Contract& contract, Report& report) {
  std::vector<std::string> names;
  for (const ParamContract& known : contract.params) names.push_back(known.name);
  const std::string name = param.value("name");
  report.error(codes::kUnknownParameter, param.place("name"),
               node.title() + ": there is no parameter " + in_quotes(name) + "; " + contract.type +
                   " has: " + xml::listed(names) + report.hint(name, names));
}

// False if the parameter cannot be used.
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

Result<Params> read_settings(const std::vector<ParamContract>& contracts,
                             const std::map<std::string, std::string>& texts) {
  xml::Diagnostics problems;
  Report report(problems);
  std::vector<std::string> names;
  for (const ParamContract& contract : contracts) names.push_back(contract.name);
  Params result;
  for (const auto& [name, text] : texts) {
    const auto declared = std::ranges::find(contracts, name, &ParamContract::name);
    const std::string title = "parameter " + in_quotes(name);
    if (declared == contracts.end()) {
      report.error(codes::kUnknownParameter, {},
                   "there is no " + title + "; there are: " + xml::listed(names) + report.hint(name, names));
    } else if (declared->fixed) {
      report.line({},
                  title + " cannot change while the component runs; change it in the graph and start anew");
    } else if (auto value = read_value({text, {}, true, ""}, *declared, title, report)) {
      result[name] = std::move(*value);
    }
  }
  if (!problems.has_errors()) return result;
  std::string lines;
  for (const xml::Diagnostic& problem : problems.sorted())
    lines += (lines.empty() ? "" : "\n") + problem.message;
  return fail(Code::invalid_argument, lines);
}

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
