// SPDX-License-Identifier: GPL-3.0-or-later
// What an operator reads of a running system, or edits with a word, is the system itself and nothing more: for every shipped
// graph, with the contracts of the shipped plugins.
#include "applying/graph_edit.hpp"

#include <catch2/catch.hpp>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <regex>
#include <string>
#include <vector>

#include "orca/graph/diff.hpp"
#include "orca/graph/loader.hpp"
#include "orca/graph/print.hpp"
#include "orca/host/catalogue.hpp"

using namespace orca;
using namespace orca::supervisor;

namespace {

namespace fs = std::filesystem;

std::vector<std::string> shipped_graphs() {
  std::vector<std::string> files;
  for (const auto& entry : fs::directory_iterator(ORCA_SOURCE_DIR "/graphs"))
    if (entry.path().extension() == ".xml") files.push_back(entry.path().string());
  return files;
}

std::string contents_of(const std::string& file) {
  std::ifstream stream(file);
  return {std::istreambuf_iterator<char>(stream), {}};
}

// Reads graphs as the deployer of a run with these options does.
class Deployer {
 public:
  explicit Deployer(graph::LoadOptions options = {}) : options_(std::move(options)) {}

  std::optional<graph::Graph> read(const std::string& text, const std::string& file) {
    diagnostics_ = {};
    return graph::load_text(text, file, options_, catalogue_, diagnostics_);
  }
  /// Reads a graph that the system has printed, and that was saved in some other folder.
  std::optional<graph::Graph> read_back(const std::string& text) {
    options_.of_run = true;
    return read(text, "/somewhere/else/live.xml");
  }
  [[nodiscard]] std::string faults() const { return diagnostics_.text(); }

 private:
  graph::LoadOptions options_;
  host::PluginCatalogue catalogue_{plugin::PluginIndex({ORCA_BINARY_DIR "/plugins"})};
  xml::Diagnostics diagnostics_;
};

// Returns the choices of profiles that a graph offers: none, and each one beside the default one.
std::vector<std::vector<std::string>> choices_of(const std::string& text) {
  std::vector<std::vector<std::string>> choices{{}};
  std::smatch found;
  const std::string first =
      std::regex_search(text, found, std::regex("default_profile=\"(\\w+)\"")) ? found[1].str() : "";
  const std::regex profile("<profile name=\"(\\w+)\"");
  for (std::sregex_iterator one(text.begin(), text.end(), profile), end; one != end; ++one) {
    choices.push_back({(*one)[1]});
    if (!first.empty() && (*one)[1] != first) choices.push_back({first, (*one)[1]});
  }
  return choices;
}

}  // namespace

TEST_CASE("a graph that the system has printed is the system that runs, for every shipped graph and profile",
          "[supervisor][edit]") {
  std::size_t read = 0;
  std::size_t logged = 0;
  for (const std::string& file : shipped_graphs())
    for (const std::vector<std::string>& profiles : choices_of(contents_of(file))) {
      CAPTURE(file, profiles);
      Deployer deployer({.profiles = profiles});
      const auto running = deployer.read(contents_of(file), file);
      if (!running) {
        // Some profiles go with others only, and some arguments must be set.
        CHECK((!profiles.empty() || deployer.faults().find("G012") != std::string::npos));
        continue;
      }
      const std::string printed = graph::print(*running);
      const auto back = deployer.read_back(printed);
      INFO(deployer.faults());
      REQUIRE(back);
      CHECK(graph::diff_text(graph::diff(*running, *back)) == "");
      ++read;
      logged += printed.find("orca.LogServer") == std::string::npos ? 0 : 1;
    }
  CHECK(read > 40);
  CHECK(logged >= 2);
}

TEST_CASE("a setting of the command line is not made again in what the system has printed",
          "[supervisor][edit]") {
  const std::string file = ORCA_SOURCE_DIR "/graphs/scout_goto.xml";
  Deployer deployer({.settings = {"avoid.margin=0.2"}});
  auto running = deployer.read(contents_of(file), file);
  REQUIRE(running);
  for (graph::ComponentNode& node : running->components)
    if (node.name == "avoid") node.params.at("margin") = 0.3;  // as apply has changed it since
  const auto back = deployer.read_back(graph::print(*running));
  INFO(deployer.faults());
  REQUIRE(back);
  CHECK(graph::diff_text(graph::diff(*running, *back)) == "");
}

TEST_CASE("to remove a connection changes nothing else, in every shipped graph", "[supervisor][edit]") {
  std::size_t removed = 0;
  for (const std::string& file : shipped_graphs())
    for (const std::vector<std::string>& profiles : choices_of(contents_of(file))) {
      CAPTURE(file, profiles);
      Deployer deployer({.profiles = profiles});
      const auto running = deployer.read(contents_of(file), file);
      if (!running || (!profiles.empty() && profiles.back() != "log")) continue;
      for (const graph::Edge& edge : running->edges) {
        if (edge.late_bound) continue;
        const auto text = without_connection(*running, edge.from.text(), edge.to.text());
        REQUIRE(text);
        const auto wanted = deployer.read_back(*text);
        if (!wanted) continue;  // it must be there
        const std::vector<graph::Change> changes = graph::diff(*running, *wanted);
        CAPTURE(edge.name(), graph::diff_text(changes));
        REQUIRE(changes.size() == 1);
        CHECK(changes.front().part == graph::Change::Part::connection);
        ++removed;
      }
    }
  CHECK(removed > 100);
}
