// SPDX-License-Identifier: LGPL-3.0-or-later
#include "orca/graph/settings.hpp"

#include <algorithm>

#include "codes.hpp"
#include "orca/base/text.hpp"
#include "report.hpp"
#include "values.hpp"

namespace orca::graph {

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
                   "there is no " + title + "; there are: " + listed(names) + report.hint(name, names));
    } else if (declared->fixed) {
      report.line({}, title +
                          " cannot change while the component runs; exchange the component (orcactl swap ... "
                          "--set), or change it in the graph and apply that");
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

}  // namespace orca::graph
