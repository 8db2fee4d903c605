// SPDX-License-Identifier: GPL-3.0-or-later
// A world from an occupancy bitmap that the test draws: 20 m wide and 12 m high.
#include <catch2/catch.hpp>

#include "deployer.hpp"
#include "temp_folder.hpp"

using namespace orca::test;

namespace {

constexpr int kWidth = 200;
constexpr int kHeight = 120;

// Returns a PGM whose upper rows are occupied and all others free.
std::string map_with_occupied_rows(int rows) {
  std::string text = "P5\n" + std::to_string(kWidth) + " " + std::to_string(kHeight) + "\n255\n";
  text.append(static_cast<std::size_t>(kWidth * rows), '\0');
  text.append(static_cast<std::size_t>(kWidth * (kHeight - rows)), '\xff');
  return text;
}

Run drive(const std::string& map, const Words& more, const std::string& width = "20 m") {
  return run_deployer(Words{source_file("graphs/scout_hospital.xml"), "--set", "map=" + map, "--set",
                            "map_width=" + width, "--set", "x=2 m"} +
                      more + virtual_clock());
}

}  // namespace

TEST_CASE("the first row of a bitmap is the top of the world, and white is free", "[system][bitmap]") {
  const TempFolder folder;
  const std::string map = folder.write("map.pgm", map_with_occupied_rows(kHeight / 2));
  const Run below = drive(map, {"--set", "y=3 m", "--set", "goals=there: 6 3"});
  INFO(below.err);
  CHECK(below.exit_code() == 0);
  CHECK(below.arrivals().size() == 1);
  CHECK(below.contacts().empty());
  const Run above = drive(map, {"--set", "y=9 m", "--set", "goals=there: 6 9"});
  INFO(above.err);
  CHECK(above.exit_code() == 2);
  CHECK(above.out.empty());
  CHECK(above.says("inside"));
}

TEST_CASE("map_width gives a bitmap its size", "[system][bitmap]") {
  const TempFolder folder;
  const std::string map = folder.write("map.pgm", map_with_occupied_rows(kHeight / 2));
  const Words at_nine{"--set", "y=9 m", "--set", "goals=there: 6 9"};
  CHECK(drive(map, at_nine).exit_code() == 2);
  const Run doubled = drive(map, at_nine, "40 m");
  INFO(doubled.err);
  CHECK(doubled.exit_code() == 0);
}

TEST_CASE("a file that is not a bitmap is refused with its name and what is wrong", "[system][bitmap]") {
  const TempFolder folder;
  const std::string good = map_with_occupied_rows(1);
  for (const std::string& map :
       {folder.write("empty.png", ""), folder.write("text.png", "no picture"), folder.write("empty.pgm", ""),
        folder.write("cut.pgm", good.substr(0, good.size() / 2)),
        folder.write("map.pgm", "\xFF\xD8\xFF\xE0 a photograph")}) {
    const Run run = drive(map, {});
    CAPTURE(map);
    INFO(run.err);
    CHECK(run.exit_code() == 2);
    CHECK(run.out.empty());
    CHECK(run.says(map));
    CHECK(run.says("error"));
  }
}

TEST_CASE("a map_width that no floor can have is refused at its place in the graph", "[system][bitmap]") {
  const TempFolder folder;
  const std::string map = folder.write("map.pgm", map_with_occupied_rows(1));
  for (const char* width : {"0 m", "-3 m", "nan", "5 kg"}) {
    const Run run = drive(map, {"--set", std::string("map_width=") + width});
    CAPTURE(width);
    INFO(run.err);
    CHECK(run.exit_code() == 2);
    CHECK(run.says("map_width"));
    CHECK(run.says(width));
  }
}
