// SPDX-License-Identifier: GPL-3.0-or-later
// The texts of errors are part of Orca's promises. Each tests/data/graphs/broken/NAME.xml is checked, and the
// output must equal NAME.expected. A first line "<!-- options: profile P set A=B strict yes -->" stands for
// the command line. NAME.case is for graphs that do not fit in a file of moderate size; see made_graph.hpp.
#include "approval.hpp"

#include <catch2/catch.hpp>

#include <algorithm>
#include <sstream>

#include "fake_catalogue.hpp"
#include "made_graph.hpp"

namespace fs = std::filesystem;
using namespace orca;
using namespace orca::test;

namespace {

const fs::path kFolder = fs::path(ORCA_SOURCE_DIR) / "tests/data/graphs/broken";

graph::LoadOptions options_in(const std::string& text) {
  graph::LoadOptions options{.try_components = true};
  std::istringstream words(text.substr(0, text.find('\n')));
  std::string word;
  words >> word >> word;
  if (word != "options:") return options;
  for (std::string value; words >> word >> value;) {
    if (word == "strict") options.strict = true;
    if (word == "profile") options.profiles.push_back(value);
    if (word == "set") options.settings.push_back(value);
  }
  return options;
}

// Files that a graph includes, seen from the folder of the broken graphs.
Result<std::string> read_part(const std::string& path) {
  Result<std::string> bytes = xml::read_bytes((kFolder / path).string());
  return bytes;
}

std::string errors_of(const std::string& text, const std::string& name) {
  FakeCatalogue catalogue;
  xml::Diagnostics diagnostics;
  const auto loaded = graph::load_text(text, name, options_in(text), catalogue, diagnostics, read_part);
  CHECK_FALSE(loaded.has_value());
  return diagnostics.text();
}

// "load NAME" names a file that need not exist; anything else names a graph that made_graph() makes.
std::string errors_of_case(const fs::path& path) {
  const std::string order = bytes_of(path);
  if (!order.starts_with("load ")) return errors_of(made_graph(order), path.stem().string() + ".xml");
  const std::string name = order.substr(5, order.find('\n') - 5);
  FakeCatalogue catalogue;
  xml::Diagnostics diagnostics;
  CHECK_FALSE(graph::load_file((kFolder / name).string(), {}, catalogue, diagnostics).has_value());
  std::string said = diagnostics.text();
  return said.replace(0, kFolder.string().size() + 1, "");
}

std::vector<fs::path> broken_graphs() {
  std::vector<fs::path> cases = files_in(kFolder, ".xml");
  for (const fs::path& made : files_in(kFolder, ".case")) cases.push_back(made);
  return cases;
}

}  // namespace

TEST_CASE("each broken graph gives its approved errors", "[graph][approval]") {
  for (const fs::path& path : files_in(kFolder, ".xml"))
    check_approved(approved_text_of(path), errors_of(bytes_of(path), path.filename().string()));
}

TEST_CASE("each order for a broken graph gives its approved errors", "[graph][approval]") {
  for (const fs::path& path : files_in(kFolder, ".case"))
    check_approved(approved_text_of(path), errors_of_case(path));
}

TEST_CASE("there are at least two hundred broken graphs, and no approved text without its graph",
          "[graph][approval]") {
  CHECK(broken_graphs().size() >= 200);
  for (const fs::path& expected : files_in(kFolder, ".expected")) {
    INFO(expected.filename().string());
    const auto there = [&](const char* ending) {
      return fs::exists(fs::path(expected).replace_extension(ending));
    };
    CHECK((there(".xml") || there(".case")));
  }
}

TEST_CASE("every line that Orca writes has a place, a code and a message", "[graph][approval]") {
  for (const fs::path& path : broken_graphs()) {
    std::istringstream lines(bytes_of(approved_text_of(path)));
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

TEST_CASE("no line is written twice", "[graph][approval]") {
  for (const fs::path& path : broken_graphs()) {
    std::istringstream text(bytes_of(approved_text_of(path)));
    std::vector<std::string> lines;
    for (std::string line; std::getline(text, line);) lines.push_back(line);
    std::sort(lines.begin(), lines.end());
    INFO(path.filename().string());
    CHECK(std::adjacent_find(lines.begin(), lines.end()) == lines.end());
  }
}
