// SPDX-License-Identifier: GPL-3.0-or-later
// What a graph says of the time that computing a lap takes.
#include "orca/graph/laps.hpp"

#include <catch2/catch.hpp>

#include "loading.hpp"
#include "orca/graph/print.hpp"
#include "temp_folder.hpp"

using namespace orca;
using namespace orca::graph;
using namespace orca::test;
using Catch::Contains;

namespace {

std::string graph_with(const std::string& component) { return "<graph name='g'>" + component + "</graph>"; }

std::string localizer(const std::string& takes, const std::string& name = "a") {
  return "<component name='" + name + "' type='orca.Localizer' takes='" + takes + "'/>";
}

// Quantiles of 0, 1 / parts, 2 / parts seconds and so on.
std::vector<double> ramp(double parts) {
  std::vector<double> times;
  for (std::size_t i = 0; i < kLapQuantiles; ++i) times.push_back(static_cast<double>(i) / parts);
  return times;
}

// A measurement of components of these names, the first with laps of 0 to 20 ms, the next with ten times these.
std::string measured(const TempFolder& folder, const std::vector<std::string>& names) {
  LapMeasurement measurement{"other", "an \"abacus\"", "2026-11-28", {}};
  double parts = 1000.0;
  for (const std::string& name : names) {
    measurement.components.push_back({name, "orca.Localizer", 100, 10.0 / parts, ramp(parts)});
    parts /= 10.0;
  }
  return folder.write("laps.xml", laps_text(measurement));
}

std::string faults_of(const std::string& takes) {
  FakeCatalogue catalogue;
  xml::Diagnostics diagnostics;
  CHECK_FALSE(load_text(graph_with(localizer(takes)), "g.xml", {}, catalogue, diagnostics));
  return diagnostics.text();
}

}  // namespace

TEST_CASE("what laps take is a time, or a file with what was measured of the component", "[graph][laps]") {
  const TempFolder folder;
  const std::string file = measured(folder, {"a", "b"});
  const Graph graph = must_load(graph_with(localizer("20 ms", "c") + localizer(file) + localizer(file, "b")));
  CHECK(graph.find_component("c")->takes == LapTime{{}, {0.02}});
  CHECK(graph.find_component("a")->takes == LapTime{file, ramp(1000.0)});
  CHECK(graph.find_component("b")->takes == LapTime{file, ramp(100.0)});
  CHECK(must_load(print(graph)) == graph);
  CHECK_FALSE(must_load(graph_with(localizer("30 ms"))) == must_load(graph_with(localizer("20 ms"))));
}

TEST_CASE("a time between two quantiles is in proportion", "[graph][laps]") {
  const LapTime measured{"f", {0.001, 0.002, 0.006}};
  CHECK(measured.at(0.0) == 0.001);
  CHECK(measured.at(0.25) == Approx(0.0015));
  CHECK(measured.at(0.5) == Approx(0.002));
  CHECK(measured.at(0.75) == Approx(0.004));
  CHECK(LapTime{{}, {0.02}}.at(0.9) == 0.02);
}

TEST_CASE("a wrong time of laps is refused with what would be right", "[graph][laps]") {
  CHECK_THAT(faults_of("-1 ms"), Contains("G032") && Contains("takes"));
  CHECK_THAT(faults_of("20 m"), Contains("G031") && Contains("takes"));
  CHECK_THAT(faults_of("/no/such/laps.xml"), Contains("/no/such/laps.xml"));
  const TempFolder folder;
  CHECK_THAT(faults_of(measured(folder, {"b", "c"})),
             Contains("G030") && Contains("holds no laps of it; it has those of: b, c"));
  CHECK_THAT(faults_of(folder.write("x.xml", "<graph name='g'/>")),
             Contains("G001") && Contains("not <laps>"));
  CHECK_THAT(faults_of(folder.write("y.xml", "<laps><component name='a' quantiles='1 2'/></laps>")),
             Contains("y.xml:1:") && Contains("quantiles"));
  std::string falling;
  for (std::size_t i = 0; i < kLapQuantiles; ++i) falling += std::to_string(30 - i) + " ";
  CHECK_THAT(
      faults_of(folder.write("z.xml", "<laps><component name='a' quantiles='" + falling + "'/></laps>")),
      Contains("G032") && Contains("none below 0 or below the one before it"));
}

TEST_CASE("a component of a used graph has the laps of its name in that graph", "[graph][laps]") {
  const TempFolder folder;
  const std::string file = measured(folder, {"a", "left/b"});
  const std::string used =
      folder.write("used.xml", graph_with(localizer("laps.xml") + localizer("laps.xml", "b")));
  const Graph graph = must_load("<graph name='g'><use graph='" + used + "' prefix='left'/></graph>");
  CHECK(graph.find_component("left/a")->takes.quantiles == ramp(1000.0));
  CHECK(graph.find_component("left/b")->takes.quantiles == ramp(100.0));
  CHECK(graph.find_component("left/a")->takes.file == file);
}
