// SPDX-License-Identifier: GPL-3.0-or-later
// Maps as people have them: pictures of other formats and names, maps of ROS, walls in light grey.
#include <catch2/catch.hpp>

#include <algorithm>
#include <string>

#include "orca/sim/world_file.hpp"
#include "temp_folder.hpp"

using orca::test::TempFolder;

namespace {

struct WorldReading {
  std::optional<orca::sim::WorldModel> world;
  std::string said;
};

WorldReading world_of(const std::string& file, const orca::sim::BitmapScale& scale = {1.0, {}}) {
  orca::xml::Diagnostics diagnostics;
  WorldReading reading;
  reading.world = orca::sim::read_world(file, scale, diagnostics);
  reading.said = diagnostics.text();
  return reading;
}

// A picture of 40 x 40 pixels with a frame of black, as PGM, in which a part has another grey.
std::string plan_with(int grey, int width, int height) {
  std::string text = "P2\n40 40\n255\n";
  for (int y = 0; y < 40; ++y)
    for (int x = 0; x < 40; ++x) {
      const bool frame = std::min({x, y, 39 - x, 39 - y}) == 0;
      const bool part = x >= 10 && x < 10 + width && y >= 10 && y < 10 + height;
      text += std::to_string(frame ? 0 : part ? grey : 255) + (x == 39 ? '\n' : ' ');
    }
  return text;
}

}  // namespace

TEST_CASE("a picture is one by what it holds, whatever its name", "[sim][foreign]") {
  const TempFolder folder;
  for (const char* const name : {"plan.pgm", "PLAN.PGM", "plan.PNG", "plan", "plan.txt"}) {
    const WorldReading reading = world_of(folder.write(name, plan_with(255, 1, 1)));
    INFO(name << reading.said);
    REQUIRE(reading.world);
    CHECK(reading.world->obstacles.size() == 1);
  }
}

TEST_CASE("a picture that is not read hears its format and what to do", "[sim][foreign]") {
  const TempFolder folder;
  using namespace std::string_literals;
  const std::pair<const char*, std::string> kFormats[] = {{"JPEG", "\xFF\xD8\xFF\xE0 and more"s},
                                                          {"BMP", "BM\x36\x10\x0E\0\0\0\0\0\x36\0\0\0"s},
                                                          {"GIF", "GIF89a...."s},
                                                          {"TIFF", "II*\0\x08\0\0\0"s},
                                                          {"PDF", "%PDF-1.4 and more"s},
                                                          {"WebP", "RIFF\x24\0\0\0WEBPVP8 "s}};
  for (const auto& [format, bytes] : kFormats)
    for (const char* const name : {"plan.img", "plan.png", "plan.xml"}) {
      const WorldReading reading = world_of(folder.write(name, bytes));
      CHECK_FALSE(reading.world);
      CHECK_THAT(reading.said, Catch::Contains("this is a " + std::string(format) + " file") &&
                                   Catch::Contains("convert it") && !Catch::Contains("W013") &&
                                   !Catch::Contains("UTF-8"));
    }
}

TEST_CASE("the YAML file of a map hears which picture and scale to name", "[sim][foreign]") {
  const TempFolder folder;
  const WorldReading reading = world_of(
      folder.write("map.yaml",
                   "image: \"office.pgm\"\nresolution: 0.050000\norigin: [-10.0, -12.5, 0.0]\nnegate: 0\n"
                   "occupied_thresh: 0.65\nfree_thresh: 0.196\n"));
  CHECK_FALSE(reading.world);
  CHECK_THAT(reading.said, Catch::Contains("W026: this is the YAML file of a map of ROS") &&
                               Catch::Contains("office.pgm\" and map_resolution=\"0.050000 m\"") &&
                               !Catch::Contains("G10") && !Catch::Contains("negate"));
  const WorldReading turned =
      world_of(folder.write("turned.yaml", "image: office.pgm\nresolution: 0.05\nnegate: 1\n"));
  CHECK_THAT(turned.said, Catch::Contains("exchange black and white in the picture first"));
}

TEST_CASE("walls in light grey are free, and the share of such pixels is said", "[sim][foreign]") {
  const TempFolder folder;
  const WorldReading grey = world_of(folder.write("grey.pgm", plan_with(180, 16, 2)));
  REQUIRE(grey.world);
  CHECK_THAT(grey.said, Catch::Contains("warning W027: 2 % of the pixels are light grey (128 to 239)"));
  const std::string world = folder.write(
      "w.xml", "<world name='w' version='1'><bitmap file='grey.pgm' name='plan' width='4 m'/></world>");
  CHECK_THAT(world_of(world, {}).said,
             Catch::Contains("w.xml:1:") && Catch::Contains("warning W027: grey.pgm: 2 %"));
}

TEST_CASE("white, black, dark grey and the soft edges of lines are no cause for doubt", "[sim][foreign]") {
  const TempFolder folder;
  for (const std::string& plan : {plan_with(255, 5, 5), plan_with(100, 16, 2), plan_with(245, 20, 20)})
    CHECK(world_of(folder.write("plan.pgm", plan)).said.empty());
  // All round inside the black frame there is a line of grey.
  std::string text = "P2\n40 40\n255\n";
  for (int y = 0; y < 40; ++y)
    for (int x = 0; x < 40; ++x) {
      const int depth = std::min({x, y, 39 - x, 39 - y});
      text += std::to_string(depth == 0 ? 0 : depth == 1 ? 190 : 255) + (x == 39 ? '\n' : ' ');
    }
  CHECK(world_of(folder.write("soft.pgm", text)).said.empty());
}
