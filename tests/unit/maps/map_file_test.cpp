// SPDX-License-Identifier: GPL-3.0-or-later
// Maps of ROS's map_server, read and written.
#include <filesystem>
#include <iostream>

#include "deployer.hpp"
#include "map_files.hpp"
#include "orca/image/grey_image.hpp"
#include "subprocess.hpp"

using namespace orca;
using namespace orca::maps;
using namespace orca::maps::test;
using namespace orca::test;
using Cells = std::vector<int>;

namespace {

constexpr int kUnknown = 255;

Cells cells_read(const std::string& header, const std::vector<int>& greys) {
  const auto map = read_files(header, pgm(greys.size(), 1, greys));
  INFO(fault_of(map));
  REQUIRE(map);
  return cells_of(*map);
}

idl::OccupancyGrid small_map() {
  idl::OccupancyGrid map;
  map.columns(3);
  map.rows(2);
  map.resolution(0.05);
  map.corner().x(-12.25);
  map.corner().y(1e-7);
  map.corner().orientation(0.5);
  map.cells({0, 100, 255, 255, 19, 65});
  return map;
}

}  // namespace

TEST_CASE("the lowest row of the picture is row 0 of the map, whose y points up", "[maps]") {
  const auto map = read_files(kHeader, pgm(2, 3, {0, 0, 254, 0, 254, 254}));
  REQUIRE(map);
  CHECK(map->name() == "office");
  CHECK(map->columns() == 2);
  CHECK(map->rows() == 3);
  CHECK(map->resolution() == 0.05);
  CHECK(map->corner().x() == -1.0);
  CHECK(map->corner().y() == 2.0);
  CHECK(cells_of(*map) == Cells{0, 0, 0, 100, 100, 100});
}

TEST_CASE("the third number of the origin is the yaw of the map, kept within half a turn", "[maps]") {
  const auto map = read_files(with(kHeader, "2.0, 0.0]", "2.0, 4.0]"), pgm(1, 1, {0}));
  REQUIRE(map);
  CHECK(map->corner().orientation() == Approx(4.0 - 2.0 * 3.14159265358979));
}

TEST_CASE(
    "trinary: dark beyond the one threshold is occupied, light beyond the other free, between not known",
    "[maps]") {
  // Darkness of grey 89 is 0.651, of 90 0.647, of 205 0.19608, of 206 0.192.
  CHECK(cells_read(kHeader, {0, 89, 90, 205, 206, 255}) == Cells{100, 100, kUnknown, kUnknown, 0, 0});
}

TEST_CASE("negate: white is occupied", "[maps]") {
  CHECK(cells_read(with(kHeader, "negate: 0", "negate: 1"), {0, 49, 50, 165, 166, 255}) ==
        Cells{0, 0, kUnknown, kUnknown, 100, 100});
}

TEST_CASE("scale: between the thresholds cells are 1 to 99 per cent", "[maps]") {
  const std::string half = "mode: scale\n" + with(with(kHeader, "0.65", "0.8"), "0.196", "0.2");
  CHECK(cells_read(half, {0, 51, 52, 127, 203, 204, 255}) == Cells{100, 99, 98, 50, 2, 1, 0});
}

TEST_CASE("raw: greys up to 100 are per cent, others not known", "[maps]") {
  CHECK(cells_read("mode: raw\n" + kHeader, {0, 1, 100, 101, 255}) == Cells{0, 1, 100, kUnknown, kUnknown});
}

TEST_CASE("the ways in which YAML is written make no difference", "[maps]") {
  const std::string others = GENERATE(
      "%YAML 1.2\n---\n# a comment\nimage: 'map.pgm'\nresolution: 5.0e-2 # [m]\norigin:\n- -1.0\n- 2.0\n- "
      "0\nnegate: false\n"
      "occupied_thresh: .65\nfree_thresh: 0.196\n",
      "{image: \"map.pgm\", resolution: 0.05, origin: [-1, 2, 0], negate: 0, occupied_thresh: 0.65, "
      "free_thresh: 0.196}",
      "image: map.pgm\r\nresolution: 0.050000\r\norigin: [-1.000000, 2.000000, 0.000000]\r\nnegate: 0\r\n"
      "occupied_thresh: 0.65\r\nfree_thresh: 0.196\r\n\r\n",
      "author: somebody\nfloor: {number: 3}\nimage: map.pgm\nresolution: 0.05\norigin: [-1, 2, 0]\nnegate: "
      "0\n"
      "occupied_thresh: 0.65\nfree_thresh: 0.196\n");
  const auto map = read_files(others, pgm(2, 1, {0, 254}));
  INFO(others << fault_of(map));
  REQUIRE(map);
  CHECK(map->corner().x() == -1.0);
  CHECK(map->resolution() == 0.05);
  CHECK(cells_of(*map) == Cells{100, 0});
}

TEST_CASE("the picture may lie in another folder, seen from the YAML file", "[maps]") {
  const TempFolder folder;
  std::filesystem::create_directory(folder.path() / "pictures");
  folder.write("pictures/map.pgm", pgm(1, 1, {0}));
  CHECK(read_map(folder.write("office.yaml", with(kHeader, "map.pgm", "pictures/map.pgm"))));
  CHECK(read_map(folder.write("other.yaml", with(kHeader, "map.pgm", folder.file("pictures/map.pgm")))));
}

TEST_CASE("a map that is written is read again as it was, three values to a cell", "[maps]") {
  const TempFolder folder;
  REQUIRE(write_map(small_map(), folder.file("kitchen")).ok());
  const auto map = read_map(folder.file("kitchen.yaml"));
  INFO(fault_of(map));
  REQUIRE(map);
  CHECK(map->name() == "kitchen");
  CHECK(map->columns() == 3);
  CHECK(map->rows() == 2);
  CHECK(map->resolution() == 0.05);
  CHECK(map->corner().x() == -12.25);
  CHECK(map->corner().y() == 1e-7);
  CHECK(map->corner().orientation() == 0.5);
  CHECK(cells_of(*map) == Cells{0, 100, kUnknown, kUnknown, 0, 100});
  CHECK(
      read_text(folder.path() / "kitchen.yaml") ==
      "image: \"kitchen.png\"\nmode: trinary\nresolution: 0.05\norigin: [-12.25, 0.0000001, 0.5]\nnegate: 0\n"
      "occupied_thresh: 0.65\nfree_thresh: 0.196\n");
}

TEST_CASE("a map is not written over files that are there, and leaves nothing half written", "[maps]") {
  const TempFolder folder;
  const std::string old = folder.write("kitchen.png", "a picture of the kitchen");
  const Status written = write_map(small_map(), folder.file("kitchen.yaml"));
  REQUIRE_FALSE(written.ok());
  CHECK(written.error().text() == old + ": it is there already; choose another name, or remove it first");
  CHECK(read_text(old) == "a picture of the kitchen");
  CHECK_FALSE(write_map(small_map(), folder.file("no/such/folder/map")).ok());
  CHECK_FALSE(write_map({}, folder.file("empty")).ok());
  const auto files = std::distance(std::filesystem::directory_iterator(folder.path()), {});
  CHECK(files == 1);
}

TEST_CASE("files beside a map that is written stay as they are", "[maps]") {
  const TempFolder folder;
  const std::vector<std::string> others{folder.write("kitchen.png.new", "a picture"),
                                        folder.write("kitchen.yaml.new", "a list"),
                                        folder.write("kitchen.yaml.new1", "another list")};
  REQUIRE(write_map(small_map(), folder.file("kitchen")).ok());
  CHECK(read_map(folder.file("kitchen.yaml")));
  CHECK(read_text(others[0]) == "a picture");
  CHECK(read_text(others[1]) == "a list");
  CHECK(read_text(others[2]) == "another list");
  CHECK(std::distance(std::filesystem::directory_iterator(folder.path()), {}) == 5);
}

TEST_CASE("Python's Pillow and PyYAML read a map that is written", "[maps][tool]") {
  const TempFolder folder;
  REQUIRE(write_map(small_map(), folder.file("a \"quoted\" name")).ok());
  Subprocess reader({"/usr/bin/python3", ORCA_SOURCE_DIR "/tests/unit/maps/read_map.py",
                     folder.file("a \"quoted\" name.yaml")});
  const Run run = finish(reader, Seconds(20));
  if (run.exit_code() == 77) {
    std::cout << "SKIPPED: " << run.out;
    return;
  }
  INFO(run.err);
  CHECK(run.out == "L (3, 2) [205, 254, 0, 254, 0, 205] 0.05 [-12.25, 1e-07, 0.5] 0 0.65 0.196\n");
}
