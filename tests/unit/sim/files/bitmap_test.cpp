// SPDX-License-Identifier: GPL-3.0-or-later
#include <catch2/catch.hpp>

#include <chrono>
#include <filesystem>
#include <fstream>

#include "deployer.hpp"
#include "orca/sim/bitmap.hpp"
#include "orca/sim/caster.hpp"
#include "orca/sim/world_file.hpp"
#include "public_data.hpp"

using namespace orca::sim;
using orca::direction;
using orca::Vec2;

namespace {

// A temporary file that is removed at the end of the test.
class TemporaryFile {
 public:
  TemporaryFile(const std::string& name, const std::string& bytes)
      : path_(std::filesystem::temp_directory_path() / ("orca_bitmap_test_" + name)) {
    std::ofstream(path_, std::ios::binary) << bytes;
  }
  ~TemporaryFile() { std::filesystem::remove(path_); }
  TemporaryFile(const TemporaryFile&) = delete;
  TemporaryFile& operator=(const TemporaryFile&) = delete;
  [[nodiscard]] std::string path() const { return path_.string(); }

 private:
  std::filesystem::path path_;
};

std::string error_of(const std::string& bytes, BitmapScale scale = {.map_width = 1.0, .resolution = {}}) {
  const TemporaryFile file("broken.pgm", bytes);
  const auto world = read_bitmap_world(file.path(), scale);
  return world ? "" : world.error().message;
}

}  // namespace

TEST_CASE("the first image row is the top of the map and the lower left corner its origin", "[sim][bitmap]") {
  // The left pixel of the top row and the right pixel of the bottom row are black.
  const TemporaryFile file("corner.pgm", "P2 # a comment\n3 2\n255\n0 255 255\n255 255 0\n");
  const auto world = read_bitmap_world(file.path(), {.map_width = 6.0, .resolution = {}});
  REQUIRE(world);
  const Shape& map = world->obstacles.at(0).shape;
  CHECK(contains(map, {1.0, 3.0}));
  CHECK(contains(map, {5.0, 1.0}));
  CHECK_FALSE(contains(map, {1.0, 1.0}));
  CHECK_FALSE(contains(map, {5.0, 3.0}));
}

TEST_CASE("grey 127 is occupied and 128 is free", "[sim][bitmap]") {
  const TemporaryFile file("grey.pgm", std::string("P5 2 1 255\n\x7f\x80", 13));
  const auto world = read_bitmap_world(file.path(), {.map_width = {}, .resolution = 1.0});
  REQUIRE(world);
  CHECK(contains(world->obstacles.at(0).shape, {0.5, 0.5}));
  CHECK_FALSE(contains(world->obstacles.at(0).shape, {1.5, 0.5}));
}

TEST_CASE("runs of equal pixels become one edge with the solid to its left", "[sim][bitmap]") {
  GreyImage image{5, 4, std::vector<std::uint8_t>(20, 255)};
  for (const std::size_t i : {6U, 7U, 8U, 11U, 12U, 13U}) image.grey[i] = 0;  // A block of 3 x 2 pixels.
  const Outline outline = outline_of(image, 0.5).value();
  REQUIRE(outline.edges.size() == 4);
  const Vec2 middle{1.25, 1.0};
  for (const Segment& e : outline.edges) CHECK(cross(e.b - e.a, middle - e.a) > 0.0);
}

TEST_CASE("pixels that touch at a corner only stay two closed solids", "[sim][bitmap]") {
  const GreyImage image{2, 2, {0, 255, 255, 0}};
  CHECK(outline_of(image, 1.0)->edges.size() == 8);
}

TEST_CASE("a dithered picture, which has more edges than any plan, is refused", "[sim][bitmap]") {
  GreyImage image{1500, 1500, std::vector<std::uint8_t>(1500 * 1500)};
  for (std::size_t i = 0; i < image.grey.size(); ++i) image.grey[i] = (i / 1500 + i) % 2 == 0 ? 0 : 255;
  const auto outline = outline_of(image, 0.01);
  REQUIRE_FALSE(outline);
  CHECK_THAT(outline.error().message, Catch::Contains("2000000 edges"));
}

TEST_CASE("a picture that cannot serve as a map is refused with its reason", "[sim][bitmap]") {
  CHECK_THAT(error_of(""), Catch::Contains("the file is empty"));
  CHECK_THAT(error_of("GIF89a"), Catch::Contains("this is a GIF file"));
  CHECK_THAT(error_of("a plan"), Catch::Contains("neither a PNG nor a PGM"));
  CHECK_THAT(error_of("P5 2"), Catch::Contains("no width, height and largest value"));
  CHECK_THAT(error_of("P5 0 2 255\n"), Catch::Contains("no pixels"));
  CHECK_THAT(error_of("P5 9 9 255\nabc"), Catch::Contains("fewer pixels"));
  CHECK_THAT(error_of("P2 2 2 255\n0 0 0"), Catch::Contains("fewer pixels"));
  CHECK_THAT(error_of("P5 1 1 70000\na"), Catch::Contains("largest value 70000"));
  CHECK_THAT(error_of("P5 200000 200000 255\na"), Catch::Contains("at most 100 million"));
  CHECK_THAT(error_of("\x89PNG\r\n\x1a\nxxxxxxxxxxxxxxxxx"), Catch::Contains("damaged PNG"));
  // A PNG of 10 x 10 pixels whose first text claims 2 GB.
  using namespace std::string_literals;
  CHECK_THAT(
      error_of(
          "\x89PNG\r\n\x1a\n\0\0\0\rIHDR\0\0\0\n\0\0\0\n\b\0\0\0\0\xa8\x59\x90\x61\x7f\xff\xff\xfftEXtab"s),
      Catch::Contains("the part at byte 33 should have 2147483659 bytes, but the file has only 10 more"));
  CHECK_THAT(error_of("P5 1 1 255\na", {.map_width = {}, .resolution = 0.0}),
             Catch::Contains("resolution is"));
  CHECK_THAT(error_of("P5 1 1 255\na", {.map_width = {}, .resolution = {}}),
             Catch::Contains("give map_width"));
  CHECK_THAT(error_of("P5 1 1 255\na", {.map_width = 1.0, .resolution = 1.0}), Catch::Contains("both"));
  CHECK_THAT(error_of("P2 2 2 255\n128 255 255 255"), Catch::Contains("nothing is solid"));
  const auto missing = read_bitmap_world("/no/such/map.png", {.map_width = 1.0, .resolution = {}});
  REQUIRE_FALSE(missing);
  CHECK(missing.error().text() == "/no/such/map.png: cannot read the picture: No such file or directory");
}

TEST_CASE("a picture as world shows what is wrong with its number, its scale and itself at once",
          "[sim][bitmap]") {
  const auto codes_of = [](const std::string& bytes, const std::string& number, const BitmapScale& scale) {
    const TemporaryFile file("world.pgm", bytes);
    orca::xml::Diagnostics diagnostics;
    CHECK_FALSE(read_world(file.path() + number, scale, diagnostics).has_value());
    std::vector<std::string> codes;
    for (const auto& diagnostic : diagnostics.sorted()) codes.push_back(diagnostic.code);
    return codes;
  };
  using Codes = std::vector<std::string>;
  CHECK(codes_of("P5 1 1 255\n ", "", {}) == Codes{"W023"});
  CHECK(codes_of("P5 1 1 255\n\xff", "#3", {.map_width = 1e6, .resolution = {}}) ==
        Codes{"W017", "W023", "W011"});
  CHECK(codes_of("P5 1", "#3", {.map_width = 1.0, .resolution = {}}) == Codes{"W017", "W011"});
}

TEST_CASE("the hospital map loads in less than two seconds and casts fast", "[sim][bitmap][data]") {
  const std::string path = orca::test::public_data("stage_maps/hospital.png");
  if (path.empty()) return;
  const auto begin = std::chrono::steady_clock::now();
  const auto world = read_bitmap_world(path, {.map_width = 140.0, .resolution = {}});
  REQUIRE(world);
  const Caster caster(*world);
  const auto loaded = std::chrono::steady_clock::now();
  double sum = 0.0;
  constexpr int kRays = 200'000;
  for (int i = 0; i < kRays; ++i) sum += caster.cast({{70.0, 26.5}, direction(i * 0.001), 8.0, 0.3}).range;
  const auto done = std::chrono::steady_clock::now();
  const double load_s = std::chrono::duration<double>(loaded - begin).count();
  const double rays_per_s = kRays / std::chrono::duration<double>(done - loaded).count();
  INFO("load " << load_s << " s, " << rays_per_s / 1e6 << " million rays a second, mean " << sum / kRays
               << " m");
  CHECK(load_s < 2.0 * orca::test::kSlowCode);
  CHECK(rays_per_s > 1e5 / orca::test::kSlowCode);
  CHECK(world->bounds().high.x <= 140.0 + 1e-9);
}
