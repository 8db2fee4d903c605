// SPDX-License-Identifier: GPL-3.0-or-later
// Time to read and check a system graph, per component, as deployer --check does, but without loading
// plugins.
#include <stdexcept>

#include "benchmarks.hpp"
#include "comparison.hpp"
#include "fake_catalogue.hpp"

namespace orca::bench {
namespace {

// Returns a graph of avoiders on one base, each with a parameter and a connection.
std::string graph_of(int avoiders) {
  std::string text =
      "<graph name='big'><hardware name='robot' type='orca.hw.Sim'><param name='world' "
      "value='hall.world'/></hardware>"
      "<component name='base' type='orca.RobotBaseServer' hardware='robot'/>";
  for (int i = 0; i < avoiders; ++i) {
    const std::string name = "avoid_" + std::to_string(i);
    text += "<component name='" + name +
            "' type='orca.SonarAvoid'><param name='stop_distance' value='0.6 m'/>" +
            "</component><connect from='base.SonarRangeReadingsPush' to='" + name + ".sonar'/>";
  }
  return text + "</graph>";
}

Nanoseconds check(const std::string& text, int components) {
  FakeCatalogue catalogue;
  xml::Diagnostics diagnostics;
  return time_per_operation(components, [&] {
    if (!graph::load_text(text, "big.xml", {}, catalogue, diagnostics))
      throw std::runtime_error("the graph of the benchmark is wrong: " + diagnostics.text());
  });
}

}  // namespace

void register_graph() {
  add_row(
      {"graph check of 1000 components, per component", "of 10 components"}, 30, [](auto& state, Row& row) {
        const std::string large = graph_of(1000);
        const std::string small = graph_of(10);
        alternate(
            state, row, 1, [&](int) { return check(large, 1000); }, [&](int) { return check(small, 10); });
      });
}

}  // namespace orca::bench
