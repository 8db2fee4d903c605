// SPDX-License-Identifier: GPL-3.0-or-later
// The grey of PNG pictures of every kind, against the formulas of the standard (docs/world-files.md).
#include <catch2/catch.hpp>

#include <cmath>
#include <cstdlib>
#include <iostream>

#include "deployer.hpp"
#include "orca/sim/bitmap.hpp"
#include "png_writer.hpp"
#include "temp_folder.hpp"

using namespace orca::sim;
using namespace orca::test;
using Samples = std::vector<std::uint32_t>;
using Greys = std::vector<int>;

namespace {

Greys greys_of_file(const std::string& path) {
  const auto image = orca::image::read_image(path);
  if (!image) FAIL(image.error().text());
  return {image->grey.begin(), image->grey.end()};
}

Greys greys_of(const std::string& picture, const std::string& name = "picture.png") {
  const TempFolder folder;
  return greys_of_file(folder.write(name, picture));
}

// The light of a sample between 0 and 1, and the grey of a light; sRGB as the exponent 2.2.
double light_of(double sample, double gamma = 1.0 / 2.2) { return std::pow(sample, 1.0 / gamma); }
double grey_of(double light) { return 255.0 * std::pow(light, 1.0 / 2.2); }

// Rounding to 8 bits before and after the conversion costs a whole step at most.
void check_near(const Greys& read, const std::vector<double>& right) {
  REQUIRE(read.size() == right.size());
  for (std::size_t i = 0; i < read.size(); ++i) {
    CAPTURE(i, right[i]);
    CHECK(std::abs(read[i] - right[i]) <= 1.0);
  }
}

Samples ramp(std::uint32_t step) {
  Samples samples;
  for (std::uint32_t value = 0; value < 256; ++value) samples.push_back(value * step);
  return samples;
}

Greys all_greys() {
  const Samples values = ramp(1);
  return {values.begin(), values.end()};
}

}  // namespace

TEST_CASE("a sample without a tag is sRGB, at 8 bits as at 16", "[sim][bitmap][png]") {
  CHECK(greys_of(png_row(PngColour::grey, 8, ramp(1))) == all_greys());
  CHECK(greys_of(png_row(PngColour::grey, 16, ramp(257))) == all_greys());
  CHECK(greys_of(png_row(PngColour::grey, 16, ramp(257), srgb_tag())) == all_greys());
  CHECK(greys_of(png_row(PngColour::grey, 16, {127 * 257 + 128, 127 * 257 + 129})) == Greys{127, 128});
}

TEST_CASE("a picture of 16 bits is the same map as PNG and as PGM", "[sim][bitmap][png]") {
  Samples samples;
  std::string pgm = "P5 1300 1 65535\n";
  for (std::uint32_t i = 0; i < 1300; ++i) samples.push_back(i * 50);
  for (const std::uint32_t sample : samples) pgm += big_endian(sample, 2);
  CHECK(greys_of(png_row(PngColour::grey, 16, samples)) == greys_of(pgm, "picture.pgm"));
}

TEST_CASE("a gamma tag is followed at both depths", "[sim][bitmap][png]") {
  const double gamma = GENERATE(1.0, 1.0 / 1.8, 1.0 / 2.6, 0.2);
  CAPTURE(gamma);
  std::vector<double> right;
  for (int value = 0; value < 256; ++value) right.push_back(grey_of(light_of(value / 255.0, gamma)));
  check_near(greys_of(png_row(PngColour::grey, 8, ramp(1), gamma_tag(gamma))), right);
  check_near(greys_of(png_row(PngColour::grey, 16, ramp(257), gamma_tag(gamma))), right);
}

TEST_CASE("the gamma of sRGB changes nothing, and the sRGB tag goes before a gamma", "[sim][bitmap][png]") {
  CHECK(greys_of(png_row(PngColour::grey, 8, ramp(1), gamma_tag(0.45455))) == all_greys());
  CHECK(greys_of(png_row(PngColour::grey, 8, ramp(1), srgb_tag() + gamma_tag(1.0))) == all_greys());
  CHECK(greys_of(png_row(PngColour::grey, 16, ramp(257), gamma_tag(1.0) + srgb_tag())) == all_greys());
}

TEST_CASE("the samples of 1, 2 and 4 bits reach from black to white", "[sim][bitmap][png]") {
  CHECK(greys_of(png_row(PngColour::grey, 1, {1, 0, 0, 1, 1, 0, 1, 1, 0, 1})) ==
        Greys{255, 0, 0, 255, 255, 0, 255, 255, 0, 255});
  CHECK(greys_of(png_row(PngColour::grey, 2, {0, 1, 2, 3, 1})) == Greys{0, 85, 170, 255, 85});
  CHECK(greys_of(png_row(PngColour::grey, 4, {0, 7, 8, 15, 1})) == Greys{0, 119, 136, 255, 17});
}

TEST_CASE("a palette gives its colours at each depth", "[sim][bitmap][png]") {
  const std::string two = png_chunk("PLTE", "\x80\x80\x80\x20\x20\x20");
  CHECK(greys_of(png_row(PngColour::palette, 1, {0, 1, 1, 0}, two)) == Greys{128, 32, 32, 128});
  CHECK(greys_of(png_row(PngColour::palette, 2, {0, 1, 1, 0}, two)) == Greys{128, 32, 32, 128});
  CHECK(greys_of(png_row(PngColour::palette, 4, {0, 1, 1, 0}, two)) == Greys{128, 32, 32, 128});
  CHECK(greys_of(png_row(PngColour::palette, 8, {0, 1, 1, 0}, two)) == Greys{128, 32, 32, 128});
  check_near(greys_of(png_row(PngColour::palette, 8, {0, 1}, gamma_tag(1.0) + two)),
             {grey_of(128.0 / 255.0), grey_of(32.0 / 255.0)});
}

TEST_CASE("a transparent colour of a palette or of a grey picture is white", "[sim][bitmap][png]") {
  using namespace std::string_literals;
  const std::string black_twice = png_chunk("PLTE", std::string(6, '\0')) + png_chunk("tRNS", "\0\xFF"s);
  CHECK(greys_of(png_row(PngColour::palette, 8, {0, 1}, black_twice)) == Greys{255, 0});
  const std::string key = png_chunk("tRNS", big_endian(7, 2));
  CHECK(greys_of(png_row(PngColour::grey, 8, {7, 8}, key)) == Greys{255, 8});
}

TEST_CASE("colours count by their luminance", "[sim][bitmap][png]") {
  const std::vector<double> right{grey_of(0.2126), grey_of(0.7152), grey_of(0.0722), grey_of(0.9278)};
  const Samples red_green_blue_yellow{1, 0, 0, 0, 1, 0, 0, 0, 1, 1, 1, 0};
  for (const int depth : {8, 16}) {
    CAPTURE(depth);
    Samples samples;
    for (const std::uint32_t sample : red_green_blue_yellow) samples.push_back(sample * ((1U << depth) - 1));
    check_near(greys_of(png_row(PngColour::rgb, depth, samples)), right);
    check_near(greys_of(png_row(PngColour::rgb, depth, samples, gamma_tag(1.0))), right);
  }
}

TEST_CASE("what is partly transparent is laid on white by its light", "[sim][bitmap][png]") {
  const auto over_white = [](int sample, int alpha) {
    return grey_of(light_of(sample / 255.0) * alpha / 255.0 + 1.0 - alpha / 255.0);
  };
  std::vector<double> right;
  Samples grey;
  Samples rgb;
  Samples wide;
  for (const std::uint32_t sample : {0, 60, 128, 250}) {
    for (const std::uint32_t alpha : {0, 1, 100, 200, 254, 255}) {
      right.push_back(over_white(static_cast<int>(sample), static_cast<int>(alpha)));
      grey.insert(grey.end(), {sample, alpha});
      rgb.insert(rgb.end(), {sample, sample, sample, alpha});
      wide.insert(wide.end(), {sample * 257, alpha * 257});
    }
  }
  check_near(greys_of(png_row(PngColour::grey_alpha, 8, grey)), right);
  check_near(greys_of(png_row(PngColour::rgb_alpha, 8, rgb)), right);
  check_near(greys_of(png_row(PngColour::grey_alpha, 16, wide)), right);
}

TEST_CASE("a dark room drawn with 16 bits is solid", "[sim][bitmap][png]") {
  const TempFolder folder;
  const std::string file =
      folder.write("dark.png", png_row(PngColour::grey, 16, {100 * 257, 200 * 257, 127 * 257, 128 * 257}));
  const auto world = read_bitmap_world(file, {.map_width = 4.0, .resolution = {}});
  REQUIRE(world);
  const Shape& map = world->obstacles.at(0).shape;
  CHECK(contains(map, {0.5, 0.5}));
  CHECK_FALSE(contains(map, {1.5, 0.5}));
  CHECK(contains(map, {2.5, 0.5}));
  CHECK_FALSE(contains(map, {3.5, 0.5}));
}

TEST_CASE("PNG pictures that Netpbm makes have the grey of their samples", "[sim][bitmap][png][tool]") {
  if (std::system("pnmtopng -version </dev/null >/dev/null 2>&1") != 0) {
    std::cout << "SKIPPED: pnmtopng, of Debian's package netpbm, is not installed\n";
    return;
  }
  const TempFolder folder;
  const auto made = [&](const std::string& options, const std::string& text) {
    const std::string source = folder.write("source.pnm", text + "\n");
    const std::string result = folder.file("made.png");
    REQUIRE(std::system(
                ("pnmtopng " + options + " '" + source + "' >'" + result + "' 2>/dev/null").c_str()) == 0);
    return greys_of_file(result);
  };
  folder.write("mask.pgm", "P2 3 1 255 255 128 0\n");
  CHECK(made("", "P2 3 1 65535 25700 32639 51401") == Greys{100, 127, 200});
  CHECK(made("-interlace", "P2 3 2 65535 0 32639 51401 25700 1000 65535") == Greys{0, 127, 200, 100, 4, 255});
  CHECK(made("", "P1 9 1 1 0 1 0 0 0 0 0 1") == Greys{0, 255, 0, 255, 255, 255, 255, 255, 0});
  CHECK(made("", "P3 3 1 255 255 0 0 9 9 9 255 255 255") == Greys{126, 9, 255});
  CHECK(made("-transparent black", "P2 3 1 255 0 100 200") == Greys{255, 100, 200});
  check_near(made("-gamma 1.0", "P2 3 1 255 10 55 56"),
             {grey_of(10 / 255.0), grey_of(55 / 255.0), grey_of(56 / 255.0)});
  check_near(made("-alpha='" + folder.file("mask.pgm") + "'", "P2 3 1 255 60 0 0"),
             {60.0, grey_of(1.0 - 128.0 / 255.0), 255.0});
}
