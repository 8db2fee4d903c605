// SPDX-License-Identifier: GPL-3.0-or-later
// Additional permission: LICENSES/Orca-plugin-exception.txt
#include "import.hpp"

#include <cstdio>

#include "asking.hpp"
#include "component_file.hpp"
#include "orca/base/input_file.hpp"
#include "table.hpp"

namespace orca::orcactl {
namespace {

constexpr std::size_t kLongest = std::size_t{1} << 20;  // [bytes] of a file that people have written

}  // namespace

ExitCode import_file(const apps::Call& call) {
  const std::string& name = call.words.front();
  Result<std::string> text = read_input_file(name, kLongest);
  if (!text) return report({fail(text.error().code, text.error().message, name)});
  xml::Diagnostics found;
  const importing::ComponentFile file = importing::read_component_file(std::move(*text), name, found);
  const std::string graph = found.has_errors() ? "" : importing::graph_text(file, name, found);
  std::fputs(found.text().c_str(), stderr);
  if (found.has_errors()) return ExitCode::refused;
  print(graph);
  return ExitCode::done;
}

}  // namespace orca::orcactl
