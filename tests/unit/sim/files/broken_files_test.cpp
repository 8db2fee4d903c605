// SPDX-License-Identifier: GPL-3.0-or-later
// The texts of errors in worlds and robots are part of Orca's promises: each file of
// tests/data/worlds/broken and tests/data/robots/broken is read, and the messages must equal its .expected.
#include <catch2/catch.hpp>

#include <chrono>

#include "approval.hpp"
#include "orca/sim/robot_file.hpp"
#include "orca/sim/world_file.hpp"

namespace fs = std::filesystem;
using namespace orca;
using namespace orca::test;

namespace {

const fs::path kWorlds = fs::path(ORCA_SOURCE_DIR) / "tests/data/worlds/broken";
const fs::path kRobots = fs::path(ORCA_SOURCE_DIR) / "tests/data/robots/broken";

// Returns the messages, with the folder left out.
std::string text_of(const xml::Diagnostics& diagnostics, const fs::path& folder) {
  std::string text = diagnostics.text();
  const std::string prefix = folder.string() + "/";
  for (std::size_t at = text.find(prefix); at != std::string::npos; at = text.find(prefix, at))
    text.erase(at, prefix.size());
  return text;
}

template <class Read>
void check_folder(const fs::path& folder, const char* ending, Read&& read) {
  for (const fs::path& path : files_in(folder, ending)) {
    INFO(path.string());
    xml::Diagnostics diagnostics;
    CHECK_FALSE(read(path.string(), diagnostics));
    check_approved(approved_text_of(path), text_of(diagnostics, folder));
  }
}

double seconds_since(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

}  // namespace

TEST_CASE("each broken world gives its approved errors", "[sim][approval]") {
  check_folder(kWorlds, ".xml", [](const std::string& path, xml::Diagnostics& diagnostics) {
    return sim::read_world(path, {}, diagnostics).has_value();
  });
}

TEST_CASE("each broken file of many worlds gives its approved errors", "[sim][approval]") {
  check_folder(kWorlds, ".csv", [](const std::string& path, xml::Diagnostics& diagnostics) {
    return sim::read_world(path + "#1", {}, diagnostics).has_value();
  });
}

TEST_CASE("each broken robot gives its approved errors", "[sim][approval]") {
  check_folder(kRobots, ".urdf", [](const std::string& path, xml::Diagnostics& diagnostics) {
    return sim::read_robot(path, diagnostics).has_value();
  });
}

TEST_CASE("no approved text without its world or robot", "[sim][approval]") {
  for (const fs::path& expected : files_in(kWorlds, ".expected"))
    CHECK((fs::exists(fs::path(expected).replace_extension(".xml")) ||
           fs::exists(fs::path(expected).replace_extension(".csv"))));
  for (const fs::path& expected : files_in(kRobots, ".expected"))
    CHECK(fs::exists(fs::path(expected).replace_extension(".urdf")));
}

TEST_CASE("a world of ten thousand obstacles and a thousand places is read in a moment", "[sim][limits]") {
  std::string content = "<world name='w' version='1'>";
  for (int i = 0; i < 10'000; ++i)
    content +=
        "<cylinder x='" + std::to_string(i % 100) + "' y='" + std::to_string(i / 100) + "' radius='0.1'/>";
  for (int i = 0; i < 1000; ++i)
    content += "<place name='p" + std::to_string(i) + "' x='0.5' y='" + std::to_string(i) + ".5'/>";
  const auto start = std::chrono::steady_clock::now();
  xml::Diagnostics diagnostics;
  CHECK(sim::read_world_text(content + "</world>", "w.xml", diagnostics).has_value());
  CHECK(seconds_since(start) < 20.0);
}

TEST_CASE("a world beyond its limits is refused, in a moment, whatever it holds", "[sim][limits]") {
  const auto many = [](std::size_t count, const std::string& element) {
    std::string content = "<world name='w' version='1'>\n";
    for (std::size_t i = 0; i < count; ++i) content += element;
    xml::Diagnostics diagnostics;
    const auto start = std::chrono::steady_clock::now();
    CHECK_FALSE(sim::read_world_text(content + "</world>", "w.xml", diagnostics).has_value());
    CHECK(seconds_since(start) < 20.0);
    return diagnostics.text();
  };
  CHECK_THAT(
      many(100'001, "<cylinder x='0' y='0' radius='1'/>"),
      Catch::StartsWith("w.xml:1:1: error W014: the world has 100001 obstacles, at most 100000 are read"));
  CHECK_THAT(many(1001, "<plase name='p' x='0' y='0'/>"), Catch::Contains("the world has 1001 places"));
  CHECK_THAT(many(1001, "<place name='p' x='0' y='0'/>"),
             Catch::Contains("w.xml:1:1: error W014: the world has 1001 places, at most 1000 are read"));
}
