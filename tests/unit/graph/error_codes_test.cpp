// SPDX-License-Identifier: GPL-3.0-or-later
#include <catch2/catch.hpp>

#include <filesystem>
#include <fstream>
#include <set>
#include <sstream>

namespace fs = std::filesystem;

namespace {

// Returns every "Gnnn", or code of another letter, of a file that stands between `before` and `after`.
std::set<std::string> codes_in(const fs::path& path, const std::string& before, const std::string& after,
                               char letter = 'G') {
  std::ostringstream text;
  text << std::ifstream(path).rdbuf();
  const std::string all = text.str();
  std::set<std::string> codes;
  const std::string start = before + letter;
  for (std::size_t at = all.find(start); at != std::string::npos; at = all.find(start, at + 1)) {
    const std::string code = all.substr(at + before.size(), 4);
    if (all.compare(at + start.size() + 3, after.size(), after) == 0) codes.insert(code);
  }
  return codes;
}

std::set<std::string> declared_codes() {
  const fs::path sources = fs::path(ORCA_SOURCE_DIR) / "src";
  std::set<std::string> codes = codes_in(sources / "xml/codes.hpp", "\"", "\"");
  codes.merge(codes_in(sources / "runtime/graph/reading/codes.hpp", "\"", "\""));
  return codes;
}

}  // namespace

TEST_CASE("docs/errors.md explains every code, and no other", "[graph][docs]") {
  const auto documented = codes_in(fs::path(ORCA_SOURCE_DIR) / "docs/errors.md", "\n| ", " |");
  CHECK(documented == declared_codes());
}

TEST_CASE("docs/errors-elsewhere.md explains every code of the command line, and no other", "[graph][docs]") {
  const fs::path root(ORCA_SOURCE_DIR);
  const auto declared = codes_in(root / "src/apps/deployer/codes.hpp", "\"", "\"", 'C');
  CHECK(declared.size() == 5);
  CHECK(codes_in(root / "docs/errors-elsewhere.md", "\n| ", " |", 'C') == declared);
}

TEST_CASE("every code appears in the approved text of a broken graph", "[graph][approval]") {
  std::set<std::string> shown;
  for (const auto& entry : fs::directory_iterator(fs::path(ORCA_SOURCE_DIR) / "tests/data/graphs/broken"))
    if (entry.path().extension() == ".expected") shown.merge(codes_in(entry.path(), " ", ": "));
  for (const std::string& code : declared_codes()) {
    // Codes that no text of moderate size can cause, or no text at all: tested elsewhere, or a bug if one
    // occurs.
    if (code == "G101" || code == "G103" || code == "G129" || code == "G040") continue;
    INFO(code);
    CHECK(shown.contains(code));
  }
}
