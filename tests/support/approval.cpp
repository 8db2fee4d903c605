// SPDX-License-Identifier: GPL-3.0-or-later
#include "approval.hpp"

#include <catch2/catch.hpp>

#include <cstdlib>
#include <fstream>
#include <set>
#include <sstream>

namespace orca::test {

namespace fs = std::filesystem;

std::string bytes_of(const fs::path& path) {
  const std::ifstream file(path, std::ios::binary);
  INFO(path.string());
  REQUIRE(file.is_open());
  std::ostringstream text;
  text << file.rdbuf();
  return text.str();
}

void check_approved(const fs::path& expected, const std::string& found) {
  const bool approve = std::getenv("ORCA_APPROVE") != nullptr;
  if (approve) std::ofstream(expected, std::ios::binary) << found;
  INFO(expected.filename().string() << ": if the new text is better, run this test again with ORCA_APPROVE=1 "
                                       "in the environment and read the difference in git");
  if (!fs::exists(expected)) {
    FAIL_CHECK("there is no approved text yet; found:\n" << found);
  } else {
    CHECK(found == bytes_of(expected));
  }
}

std::vector<fs::path> files_in(const fs::path& folder, std::string_view ending) {
  std::set<fs::path> sorted;
  for (const auto& entry : fs::directory_iterator(folder))
    if (entry.is_regular_file() && entry.path().extension() == ending) sorted.insert(entry.path());
  return {sorted.begin(), sorted.end()};
}

fs::path approved_text_of(fs::path path) { return path.replace_extension(".expected"); }

}  // namespace orca::test
