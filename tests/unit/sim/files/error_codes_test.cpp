// SPDX-License-Identifier: GPL-3.0-or-later
// Headers, pages and approved texts have the same codes of world and robot files.
#include <catch2/catch.hpp>

#include <algorithm>
#include <set>
#include <string>

#include "approval.hpp"

namespace fs = std::filesystem;
using namespace orca::test;

namespace {

const fs::path kRoot = fs::path(ORCA_SOURCE_DIR);

bool is_digit(char c) { return c >= '0' && c <= '9'; }

// Returns every code of that letter in a text: the letter and three digits, with no letter or digit on either side.
std::set<std::string> codes_in(const std::string& text, char letter) {
  std::set<std::string> codes;
  for (std::size_t at = text.find(letter); at != std::string::npos; at = text.find(letter, at + 1)) {
    const std::string code = text.substr(at, 4);
    const bool alone = (at == 0 || std::isalnum(static_cast<unsigned char>(text[at - 1])) == 0) &&
                       (at + 4 >= text.size() || !is_digit(text[at + 4]));
    if (alone && code.size() == 4 && std::all_of(code.begin() + 1, code.end(), is_digit)) codes.insert(code);
  }
  return codes;
}

// Returns the codes of that letter that head a row of a table on the page: "| W001 | ...".
std::set<std::string> documented_codes(const std::string& name, char letter) {
  const std::string page = bytes_of(kRoot / "docs" / name);
  std::set<std::string> codes;
  for (std::size_t at = page.find("\n| "); at != std::string::npos; at = page.find("\n| ", at + 1)) {
    const std::size_t cell = at + 3;
    codes.merge(codes_in(page.substr(cell, page.find(" |", cell) - cell), letter));
  }
  return codes;
}

std::set<std::string> approved_codes(const std::string& folder, char letter) {
  std::set<std::string> codes;
  for (const fs::path& path : files_in(kRoot / "tests/data" / folder / "broken", ".expected"))
    codes.merge(codes_in(bytes_of(path), letter));
  return codes;
}

}  // namespace

TEST_CASE("docs/errors-of-worlds.md explains every code of a world, and no other", "[sim][docs]") {
  CHECK(documented_codes("errors-of-worlds.md", 'W') ==
        codes_in(bytes_of(kRoot / "sim/files/world/codes.hpp"), 'W'));
}

TEST_CASE("docs/errors-of-worlds.md explains every code of a robot, and no other", "[sim][docs]") {
  CHECK(documented_codes("errors-of-worlds.md", 'R') ==
        codes_in(bytes_of(kRoot / "src/robot_file/include/orca/robot_file/codes.hpp"), 'R'));
}

TEST_CASE("every code appears in the approved text of a broken world or robot", "[sim][approval]") {
  // Codes that need a command line or a fault of another library, and warnings, are tested elsewhere.
  std::set<std::string> worlds = approved_codes("worlds", 'W');
  std::set<std::string> robots = approved_codes("robots", 'R');
  for (const std::string& code : codes_in(bytes_of(kRoot / "sim/files/world/codes.hpp"), 'W')) {
    INFO(code);
    CHECK((worlds.contains(code) || code == "W013" || code == "W017" || code == "W023" || code == "W026" ||
           code == "W027"));
  }
  for (const std::string& code :
       codes_in(bytes_of(kRoot / "src/robot_file/include/orca/robot_file/codes.hpp"), 'R')) {
    INFO(code);
    CHECK((robots.contains(code) || code == "R024" || code == "R026" || code == "R027" || code == "R028" ||
           code == "R029" || code == "R030"));
  }
}
