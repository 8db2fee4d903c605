// SPDX-License-Identifier: GPL-3.0-or-later
// Map files that are wrong, and what people are told to do.
#include <cmath>
#include <cstdlib>
#include <limits>

#include "map_files.hpp"
#include "png_writer.hpp"

using namespace orca;
using namespace orca::maps;
using namespace orca::maps::test;
using Catch::Contains;
using orca::test::TempFolder;

namespace {

const std::string kOne = pgm(1, 1, {0});

// A room of 60 x 40 pixels, from the outside of its walls, with a slanted one in it.
std::vector<int> room(int width = 60, int height = 40) {
  return drawn(width, height, [&](int column, int row) {
    const bool wall = column < 2 || row < 2 || column >= width - 2 || row >= height - 2;
    return wall || std::abs(column - row - 5) < 2 ? 0 : 254;
  });
}

std::string refusal(const std::string& header) { return fault_of(read_files(header, kOne)); }
std::string refusal_of_picture(const std::string& picture) { return fault_of(read_files(kHeader, picture)); }

}  // namespace

TEST_CASE("a map of ROS without a key is refused with its name", "[maps][refused]") {
  for (const std::string key :
       {"image", "resolution", "origin", "negate", "occupied_thresh", "free_thresh"}) {
    CAPTURE(key);
    const std::string text = with(kHeader, key + ":", "x" + std::string(20, 'x') + ":");
    CHECK_THAT(refusal(text), Contains("office.yaml:1: " + key) && Contains(" is missing"));
  }
}

TEST_CASE("a key that is misspelt is refused at its line, even if others are right", "[maps][refused]") {
  CHECK_THAT(refusal(kHeader + "resolutoin: 0.05\n"),
             Contains("office.yaml:7: unknown key \"resolutoin\"; did you mean \"resolution\"?"));
}

TEST_CASE("a key that is given twice is refused", "[maps][refused]") {
  CHECK_THAT(refusal(kHeader + "resolution: 0.1\n"), Contains("office.yaml:7: resolution is given twice"));
}

TEST_CASE("values that no map can have are refused at their lines", "[maps][refused]") {
  using Pair = std::pair<std::string, std::string>;
  const std::vector<std::pair<Pair, std::string>> wrong{
      {{"resolution: 0.05", "resolution: 0"}, ":2: resolution is 0; it is the side of a pixel in metres"},
      {{"resolution: 0.05", "resolution: -0.05"}, ":2: resolution is -0.05"},
      {{"resolution: 0.05", "resolution: .nan"}, ":2: resolution: "},
      {{"resolution: 0.05", "resolution: 0,05"}, ":2: resolution: "},
      {{"resolution: 0.05", "resolution: 5 cm"}, ":2: resolution: "},
      {{"resolution: 0.05", "resolution: [0.05]"}, ":2: resolution must be one word or number"},
      {{"[-1.0, 2.0, 0.0]", "[-1.0, 2.0]"}, ":3: origin must be three numbers"},
      {{"[-1.0, 2.0, 0.0]", "0"}, ":3: origin must be three numbers"},
      {{"[-1.0, 2.0, 0.0]", "[-1.0, 2.0, north]"}, ":3: origin: "},
      {{"[-1.0, 2.0, 0.0]", "[-1.0, 2.0, 90]"}, ":3: origin: the yaw is 90; it is in radians"},
      {{"negate: 0", "negate: 2"}, ":4: negate is \"2\"; it must be 0 or 1"},
      {{"0.65", "65"}, ":5: occupied_thresh is 65; it must be from 0 to 1"},
      {{"0.196", "0.7"}, ":6: free_thresh must be less than occupied_thresh"},
      {{"negate: 0", "mode: ternary\nnegate: 0"},
       ":4: mode is \"ternary\"; it must be trinary, scale or raw"},
      {{"negate: 0", "mode: raw\nnegate: 1"}, ":5: negate is not possible with mode: raw"},
      {{"resolution: 0.05", "resolution: 1e300"}, ":2: resolution is 1e+300; it is the side of a pixel"},
      {{"resolution: 0.05", "resolution: 1e-300"}, "must be from 0.001 to 10, such as 0.05"},
      {{"[-1.0, 2.0, 0.0]", "[-1.0, 1e300, 0.0]"}, ":3: origin is farther away than 100000 m"}};
  for (const auto& [change, text] : wrong) {
    CAPTURE(change.second);
    CHECK_THAT(refusal(with(kHeader, change.first, change.second)), Contains(text));
  }
}

TEST_CASE("what is no YAML, and no list of keys, is refused", "[maps][refused]") {
  CHECK_THAT(refusal("image: [map.pgm\n"),
             Contains("this is no YAML (") && Contains("expected lines such as \"resolution: 0.05\""));
  CHECK_THAT(refusal("a map\n"), Contains("this is no map: expected lines such as \"resolution: 0.05\""));
  CHECK_THAT(refusal("# nothing\n"), Contains("this is no map"));
  CHECK_THAT(refusal(std::string(10'000, '[')),
             Contains("this is no YAML (") && Contains("expected lines such as \"resolution: 0.05\""));
}

TEST_CASE("a file that is empty is refused as such, whatever it is called", "[maps][refused]") {
  const TempFolder folder;
  CHECK_THAT(fault_of(read_map(folder.write("plan.png", ""), 0.1)),
             Contains("plan.png: the file is empty; expected"));
  CHECK_THAT(refusal(""), Contains("office.yaml: the file is empty; expected"));
}

TEST_CASE("a picture whose name holds control characters is refused, in both directions", "[maps][refused]") {
  CHECK_THAT(refusal(with(kHeader, "map.pgm", "\"map\\0.pgm\"")),
             Contains(":1: image holds control characters"));
  idl::OccupancyGrid map;
  map.columns(1);
  map.rows(1);
  map.resolution(0.05);
  map.cells({0});
  CHECK_FALSE(texts_of(map, "map\n.png"));
}

TEST_CASE("a map that would not be read again is not written", "[maps][refused]") {
  const double infinite = std::numeric_limits<double>::infinity();
  const auto fault = [](double resolution, double x, double yaw) {
    idl::OccupancyGrid map;
    map.columns(1);
    map.rows(1);
    map.cells({0});
    map.resolution(resolution);
    map.corner().x(x);
    map.corner().orientation(yaw);
    const Result<MapTexts> texts = texts_of(map, "map.png");
    return texts ? "" : texts.error().text();
  };
  CHECK(fault(0.05, 1.0, 0.5).empty());
  CHECK_THAT(fault(infinite, 0.0, 0.0), Contains("cells of inf m"));
  CHECK_THAT(fault(std::nan(""), 0.0, 0.0), Contains("which no map that is read may have"));
  CHECK_THAT(fault(0.05, infinite, 0.0), Contains("its corner at (inf m, 0 m, 0 rad)"));
  CHECK_THAT(fault(0.05, 0.0, std::nan("")), Contains("which no map that is read may have"));
}

TEST_CASE("files that are not there are refused with who names them", "[maps][refused]") {
  const TempFolder folder;
  CHECK_THAT(fault_of(read_map(folder.file("none.yaml"))), Contains("cannot read the map: "));
  const std::string alone = folder.write("alone.yaml", kHeader);
  CHECK_THAT(fault_of(read_map(alone)),
             Contains(folder.file("map.pgm")) &&
                 Contains(alone + " names it as its image: put it there, or correct the name"));
}

TEST_CASE("a picture that is cut off is refused", "[maps][refused]") {
  const std::string whole = pgm(60, 40, room());
  CHECK(refusal_of_picture(whole).empty());
  CHECK_THAT(refusal_of_picture(whole.substr(0, whole.size() / 2)),
             Contains("fewer pixels than the header announces"));
}

TEST_CASE("a picture of 16 bits is refused", "[maps][refused]") {
  CHECK_THAT(refusal_of_picture(pgm(1, 1, {60000}, 65535)),
             Contains("16 bits a pixel") && Contains("-depth 8"));
  const std::string png = orca::test::png_row(orca::test::PngColour::grey, 16, {0, 65535});
  CHECK_THAT(refusal_of_picture(png), Contains("16 bits a pixel"));
}

TEST_CASE("a picture in colours is refused, one whose colours are greys is read", "[maps][refused]") {
  using orca::test::png_row;
  using orca::test::PngColour;
  CHECK_THAT(refusal_of_picture(png_row(PngColour::rgb, 8, {0, 0, 0, 250, 0, 0})),
             Contains("the picture has colours"));
  CHECK(refusal_of_picture(png_row(PngColour::rgb, 8, {0, 0, 0, 254, 254, 254})).empty());
}

TEST_CASE("what is transparent in a picture is not known", "[maps]") {
  const auto map = read_files(
      kHeader, orca::test::png_row(orca::test::PngColour::grey_alpha, 8, {0, 255, 0, 0, 254, 255}));
  REQUIRE(map);
  CHECK(cells_of(*map) == std::vector<int>{100, 255, 0});
}

TEST_CASE("a picture whose width and height are exchanged is refused", "[maps][refused]") {
  CHECK_THAT(refusal_of_picture(pgm(40, 60, room())),
             Contains("width and height seem to be exchanged") &&
                 Contains("which says 40 x 60; correct it to 60 x 40"));
  CHECK(refusal_of_picture(pgm(40, 60, room(40, 60))).empty());
}

TEST_CASE("a corridor, along whose walls pixels are alike, is no picture with exchanged sides", "[maps]") {
  const int outside = GENERATE(205, 254);
  const int doors = GENERATE(0, 4, 8, 16);
  CAPTURE(outside, doors);
  // 50 m by 2.4 m within 1000 x 60 pixels, with doors of 0.8 m in both walls.
  const auto grey_at = [&](int column, int row) {
    const bool beside = row < 6 || row >= 54 || column < 2 || column >= 998;
    if (beside) return outside;
    const bool door = doors > 0 && column % (1000 / doors) >= 20 && column % (1000 / doors) < 36;
    const bool end = column < 4 || column >= 996;
    return ((row < 8 || row >= 52) && !door) || end ? 0 : 254;
  };
  CHECK(refusal_of_picture(pgm(1000, 60, drawn(1000, 60, grey_at))).empty());
  const auto upright = drawn(60, 1000, [&](int column, int row) { return grey_at(row, column); });
  CHECK(refusal_of_picture(pgm(60, 1000, upright)).empty());
}

TEST_CASE("a photograph is refused, greys as probabilities with mode: scale are not", "[maps][refused]") {
  const auto shaded = drawn(60, 40, [](int column, int row) { return 20 + 3 * column + row; });
  CHECK_THAT(refusal_of_picture(pgm(60, 40, shaded)),
             Contains("as in a photograph") && Contains("mode: scale"));
  CHECK(fault_of(read_files("mode: scale\n" + kHeader, pgm(60, 40, shaded))).empty());
}

TEST_CASE("the one grey of what is not known makes no photograph", "[maps]") {
  const auto mostly_unknown = drawn(60, 40, [](int column, int) {
    return column < 5 ? 0 : column < 10 ? 254 : 205;
  });
  CHECK(refusal_of_picture(pgm(60, 40, mostly_unknown)).empty());
}

TEST_CASE("a map that is too long for a floor is refused", "[maps][refused]") {
  const auto line = [](int pixels) {
    return "P5 " + std::to_string(pixels) + " 1 255\n" +
           std::string(static_cast<std::size_t>(pixels), '\xFE');
  };
  CHECK(refusal_of_picture(line(40'000)).empty());
  CHECK_THAT(refusal_of_picture(line(40'001)), Contains("the map is 40001 pixels long"));
  const std::string coarse = with(kHeader, "0.05", "0.5");
  CHECK(fault_of(read_files(coarse, line(4000))).empty());
  CHECK_THAT(fault_of(read_files(coarse, line(4001))),
             Contains("4001 pixels of 0.5 m are more than the 2000 m") && Contains("correct the resolution"));
}

TEST_CASE("a picture that is too large for a map is refused before its pixels are read", "[maps][refused]") {
  const std::string only_head = "P5 5001 5000 255\n";
  CHECK_THAT(refusal_of_picture(only_head), Contains("5001 x 5000 pixels; at most 25 million are read"));
  CHECK_THAT(refusal_of_picture("P5 5000 5000 255\n"), Contains("fewer pixels than the header announces"));
  std::string png = orca::test::png_row(orca::test::PngColour::grey, 8, {0});
  // The width and height of its head, whose check sum is that of its name and content.
  png.replace(16, 8, orca::test::big_endian(10'000, 4) + orca::test::big_endian(2501, 4));
  png.replace(29, 4, orca::test::big_endian(orca::test::crc_of(png.substr(12, 17)), 4));
  CHECK_THAT(refusal_of_picture(png), Contains("10000 x 2501 pixels; at most 25 million are read"));
}
