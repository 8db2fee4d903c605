// SPDX-License-Identifier: GPL-3.0-or-later
#include <sys/resource.h>

#include <ctime>

#include "loading.hpp"

using namespace orca::graph;

namespace {

// n avoiders on one base; every `every`-th one has a wrong parameter.
std::string big_graph(int n, int every) {
  std::string text =
      "<graph name='big'><hardware name='robot' type='orca.hw.Sim'/>\n"
      "<component name='base' type='orca.RobotBaseServer' hardware='robot'/>\n";
  for (int i = 0; i < n; ++i) {
    const std::string name = "avoid_" + std::to_string(i);
    const bool wrong = every > 0 && i % every == 0;
    text += "<component name='" + name + "' type='orca.SonarAvoid'>\n  <param name='" +
            std::string(wrong ? "stop_distanse" : "stop_distance") + "' value='0.6 m'/>\n</component>\n";
    text += "<connect from='base.SonarRangeReadingsPush' to='" + name + ".sonar'/>\n";
  }
  return text + "</graph>\n";
}

// Processor time [s] that this program has used: what else the machine does is not in it.
double used_seconds() {
  timespec now{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

double seconds_for(const std::string& text, std::size_t& errors) {
  FakeCatalogue catalogue;
  orca::xml::Diagnostics diagnostics;
  const double start = used_seconds();
  (void)load_text(text, "big.xml", {}, catalogue, diagnostics);
  errors = diagnostics.error_count();
  return used_seconds() - start;
}

// [s] Below what a check takes whose time grows with the square of the names, and ten times what an ordinary machine needs.
// Sanitizers are ten times slower and more, and so is a build without optimisation and with counters for coverage.
#if defined(ORCA_RELEASE)
constexpr double kBound = 10.0;
#else
constexpr double kBound = 100.0;
#endif

}  // namespace

TEST_CASE("a graph of one megabyte with fifty faults is checked in no time", "[graph][large]") {
  const std::string text = big_graph(6000, 120);
  REQUIRE(text.size() > 1'000'000);
  std::size_t errors = 0;
  CHECK(seconds_for(text, errors) < kBound);
  CHECK(errors == 50);
}

TEST_CASE("thousands of unknown names do not cost more than that", "[graph][large]") {
  std::string text = "<graph name='big'>";
  for (int i = 0; i < 9000; ++i) {
    text += "<component name='robot_" + std::to_string(i) + "' type='orca.Localizer'/>";
    text += "<connect from='rabot_" + std::to_string(i) + "x.pose' to='nobody.at_all'/>";
  }
  std::size_t errors = 0;
  CHECK(seconds_for(text + "</graph>", errors) < kBound);
  CHECK(errors == 18000);
}

TEST_CASE("ten thousand components in a row start one after the other", "[graph][large]") {
  std::string text = "<graph name='row'>";
  for (int i = 0; i < 10'000; ++i) {
    text += "<component name='c" + std::to_string(i) + "' type='orca.Localizer' start_after='c" +
            std::to_string(std::max(0, i + 1) % 10'000) + "'/>";
  }
  std::size_t errors = 0;
  CHECK(seconds_for(text + "</graph>", errors) < kBound);
  CHECK(errors == 1);
}

TEST_CASE("a circle of thousands of components is shown by its first ones", "[graph][large]") {
  std::string text = "<graph name='row'>";
  for (int i = 0; i < 1000; ++i)
    text += "<component name='c" + std::to_string(i) + "' type='orca.Localizer' start_after='c" +
            std::to_string((i + 1) % 1000) + "'/>";
  const std::string said = said_about(text + "</graph>");
  CHECK(said.find("c10 -> c11 -> 988 more -> c0; none of them") != std::string::npos);
}

TEST_CASE("more than ten thousand components are refused", "[graph][large]") {
  std::string text = "<graph name='many'>\n";
  for (int i = 0; i <= 10'000; ++i)
    text += "<component name='c" + std::to_string(i) + "' type='orca.Localizer'/>\n";
  const std::string said = said_about(text + "</graph>");
  CHECK(said == "test.xml:10002:1: error G040: the graph has 10001 components, the limit is 10000\n");
}

namespace {

// Returns the most memory that this process has had [MB].
double peak_memory() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<double>(usage.ru_maxrss) / 1024.0;
}

// 10,000 components in a chain that forks, 20,000 connections.
std::string widest_graph() {
  std::string text = "<graph name='wide'>\n";
  for (int i = 0; i < 10'000; ++i)
    text += "<component name='c" + std::to_string(i) + "' type='orca.Relay'/>\n";
  for (int i = 0; i < 20'000; ++i)
    text += "<connect from='c" + std::to_string(i / 2) + ".out' to='c" + std::to_string((i + 1) % 10'000) +
            ".in'/>\n";
  return text + "</graph>\n";
}

}  // namespace

TEST_CASE("ten thousand components with twenty thousand connections are checked in no time and 500 MB",
          "[graph][large]") {
  const std::string text = widest_graph();
  std::size_t errors = 0;
  const double seconds = seconds_for(text, errors);
  WARN("checked in " << seconds << " s; the test program had " << peak_memory() << " MB at most");
  CHECK(errors == 0);
  CHECK(seconds < kBound);
#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
  CHECK(peak_memory() < 500.0);
#endif
}

TEST_CASE("a file that a graph includes a thousand times is read once", "[graph][large]") {
  int reads = 0;
  std::string text = "<graph name='g'>";
  for (int i = 0; i < 1000; ++i) text += "<use graph='p.xml' prefix='p" + std::to_string(i) + "'/>";
  FakeCatalogue catalogue;
  orca::xml::Diagnostics diagnostics;
  const auto read = [&](const std::string&) -> orca::Result<std::string> {
    ++reads;
    return std::string("<graph name='p'><component name='a' type='orca.Label'/></graph>");
  };
  const auto graph = load_text(text + "</graph>", "g.xml", {}, catalogue, diagnostics, read);
  REQUIRE(graph.has_value());
  CHECK(graph->components.size() == 1000);
  CHECK(reads == 1);
}

TEST_CASE("files that include each other tenfold, ten deep, end in one error and in no time",
          "[graph][large]") {
  Files files;
  for (int i = 0; i < 10; ++i) {
    std::string content;
    for (int k = 0; k < 10; ++k) content += "<use graph='f" + std::to_string(i + 1) + ".xml' prefix='p'/>";
    files[i == 0 ? "main.xml" : "f" + std::to_string(i) + ".xml"] = "<graph name='g'>" + content + "</graph>";
  }
  files["f10.xml"] = "<graph name='g'/>";
  orca::xml::Diagnostics diagnostics;
  const double start = used_seconds();
  CHECK_FALSE(load_files(files, diagnostics).has_value());
  const double seconds = used_seconds() - start;
  CHECK(diagnostics.error_count() == 1);
  CHECK(seconds < kBound);
}

TEST_CASE(
    "files that include each other twice, eighteen deep, with a component at the end, are refused in no time",
    "[graph][large]") {
  Files files;
  for (int i = 0; i < 18; ++i) {
    const std::string next = "<include file='f" + std::to_string(i + 1) + ".xml'/>";
    files[i == 0 ? "main.xml" : "f" + std::to_string(i) + ".xml"] =
        "<graph name='g'>" + next + next + "</graph>";
  }
  files["f18.xml"] = "<graph name='g'><component name='a' type='orca.Label'/></graph>";
  orca::xml::Diagnostics diagnostics;
  const double start = used_seconds();
  CHECK_FALSE(load_files(files, diagnostics).has_value());
  const double seconds = used_seconds() - start;
  WARN("refused in " << seconds << " s");
  CHECK_THAT(diagnostics.text(),
             Catch::Contains("G045: with this file the graph includes and uses files more than 10000 times"));
  CHECK(seconds < kBound);
}
