// SPDX-License-Identifier: GPL-3.0-or-later
// The texts of errors are part of what Orca promises. Each tests/data/graphs/broken/NAME.xml is checked, and
// what comes out must equal NAME.expected. A first line "<!-- options: profile P set A=B -->" stands for
// the command line.
#include <catch2/catch.hpp>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <set>
#include <sstream>

#include "fake_catalogue.hpp"

namespace fs = std::filesystem;
using namespace orca;

namespace {

const fs::path kFolder = fs::path(ORCA_SOURCE_DIR) / "tests/data/graphs/broken";

std::string content(const fs::path& path) {
  std::ostringstream text;
  text << std::ifstream(path, std::ios::binary).rdbuf();
  return text.str();
}

graph::LoadOptions options_in(const std::string& text) {
  graph::LoadOptions options;
  std::istringstream words(text.substr(0, text.find('\n')));
  std::string word;
  words >> word >> word;
  if (word != "options:") return options;
  for (std::string value; words >> word >> value;)
    (word == "profile" ? options.profiles : options.settings).push_back(value);
  return options;
}

std::string errors_of(const fs::path& path) {
  const std::string text = content(path);
  FakeCatalogue catalogue;
  xml::Diagnostics diagnostics;
  const auto loaded =
      graph::load_text(text, path.filename().string(), options_in(text), catalogue, diagnostics);
  CHECK_FALSE(loaded.has_value());
  return diagnostics.text();
}

std::vector<fs::path> broken_graphs() {
  std::set<fs::path> sorted;
  for (const auto& entry : fs::directory_iterator(kFolder))
    if (entry.path().extension() == ".xml") sorted.insert(entry.path());
  return {sorted.begin(), sorted.end()};
}

fs::path expected_file(fs::path path) { return path.replace_extension(".expected"); }

}  // namespace

TEST_CASE("each broken graph gives its approved errors", "[graph][approval]") {
  const bool approve = std::getenv("ORCA_APPROVE") != nullptr;
  for (const fs::path& path : broken_graphs()) {
    const std::string found = errors_of(path);
    if (approve) std::ofstream(expected_file(path), std::ios::binary) << found;
    INFO(path.filename().string() << ": if the new text is better, approve it with\n"
                                     "  ORCA_APPROVE=1 build/release/tests/graph_test \"[approval]\"\n"
                                     "and read the difference in git");
    CHECK(found == content(expected_file(path)));
  }
}

TEST_CASE("there are at least sixty broken graphs, and no approved text without its graph",
          "[graph][approval]") {
  CHECK(broken_graphs().size() >= 60);
  for (const auto& entry : fs::directory_iterator(kFolder)) {
    if (entry.path().extension() != ".expected") continue;
    INFO(entry.path().filename().string());
    CHECK(fs::exists(fs::path(entry.path()).replace_extension(".xml")));
  }
}

TEST_CASE("every line that Orca writes has a place, a code and a message", "[graph][approval]") {
  for (const fs::path& path : broken_graphs()) {
    std::istringstream lines(content(expected_file(path)));
    for (std::string line; std::getline(lines, line);) {
      INFO(path.filename().string() << ": " << line);
      const std::size_t kind = std::min(line.find(": error G"), line.find(": warning G"));
      const bool elsewhere = line.starts_with("... and ") || line.starts_with("broken.world:");
      CHECK((elsewhere || kind != std::string::npos));
      if (elsewhere || line.starts_with("command line: ")) continue;
      CHECK(std::count(line.begin(), line.begin() + static_cast<std::ptrdiff_t>(kind), ':') == 2);
    }
  }
}
