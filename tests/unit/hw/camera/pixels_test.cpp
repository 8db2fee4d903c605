// SPDX-License-Identifier: GPL-3.0-or-later
// Pictures of cameras to RGB8 and MONO8, beside the formulas of ITU-R BT.601 in real numbers.
#include <catch2/catch.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <random>
#include <vector>

#include "orca/hw/camera/pixels.hpp"

using namespace orca::hw::camera;

namespace {

using Picture = std::vector<std::uint8_t>;
using Pixel = std::array<int, 3>;

// The range of luma and of the differences, on which BT.601 puts E' and E'C.
struct Range {
  bool is_full;
  [[nodiscard]] double light(int y) const { return is_full ? y / 255.0 : (y - 16) / 219.0; }
  [[nodiscard]] double difference(int c) const { return (c - 128) / (is_full ? 255.0 : 224.0); }
};

int level(double share) { return static_cast<int>(std::lround(std::clamp(255.0 * share, 0.0, 255.0))); }

// BT.601: E'Y = 0.299 R + 0.587 G + 0.114 B, E'CR = (R - E'Y) / 1.402, E'CB = (B - E'Y) / 1.772.
Pixel rgb_of(const Range& range, int y, int cb, int cr) {
  const double light = range.light(y);
  const double red = light + 1.402 * range.difference(cr);
  const double blue = light + 1.772 * range.difference(cb);
  const double green = (light - 0.299 * red - 0.114 * blue) / 0.587;
  return {level(red), level(green), level(blue)};
}

Layout layout_of(PixelFormat format, std::size_t width, std::size_t height, std::size_t padding = 0,
                 bool full_range = false) {
  Layout layout{format, width, height, 0, full_range};
  layout.step = least_step(layout) + padding;
  return layout;
}

Picture converted(const Layout& layout, const Picture& raw, Channels channels) {
  Picture into(layout.width * layout.height * static_cast<std::size_t>(channels));
  REQUIRE(convert(layout, raw, channels, into));
  return into;
}

Pixel pixel_of(const Picture& rgb, std::size_t number) {
  return {rgb[3 * number], rgb[3 * number + 1], rgb[3 * number + 2]};
}

int distance(const Pixel& a, const Pixel& b) {
  int most = 0;
  for (std::size_t i = 0; i < 3; ++i) most = std::max(most, std::abs(a[i] - b[i]));
  return most;
}

Picture random_bytes(std::size_t count, unsigned seed) {
  std::mt19937 random(seed);
  Picture bytes(count);
  for (std::uint8_t& byte : bytes) byte = static_cast<std::uint8_t>(random());
  return bytes;
}

}  // namespace

TEST_CASE("YUYV becomes RGB as BT.601 says, within one step, over all lumas and differences",
          "[camera][pixels]") {
  for (const bool full : {false, true}) {
    int worst = 0;
    int off = 0;
    int count = 0;
    for (int y = 0; y < 256; y += 3)
      for (int cb = 0; cb < 256; cb += 5)
        for (int cr = 0; cr < 256; cr += 5) {
          const Picture raw{static_cast<std::uint8_t>(y), static_cast<std::uint8_t>(cb),
                            static_cast<std::uint8_t>(255 - y), static_cast<std::uint8_t>(cr)};
          Picture rgb(6);
          if (!convert(layout_of(PixelFormat::yuyv, 2, 1, 0, full), raw, Channels::rgb, rgb)) FAIL("refused");
          const int here = std::max(distance(pixel_of(rgb, 0), rgb_of({full}, y, cb, cr)),
                                    distance(pixel_of(rgb, 1), rgb_of({full}, 255 - y, cb, cr)));
          worst = std::max(worst, here);
          off += here != 0;
          ++count;
        }
    CAPTURE(full);
    CHECK(worst <= 1);
    CHECK(off < count / 100);  // only where the real value lies at the edge between two steps
  }
}

TEST_CASE("the colours of test bars come out as they went in", "[camera][pixels]") {
  struct Bar {
    std::uint8_t y, cb, cr;
    Pixel rgb;
  };
  // Full colours after BT.601, quantized to 8 bits, which costs up to a step and a half of a colour.
  for (const Bar& bar :
       {Bar{235, 128, 128, {255, 255, 255}}, Bar{16, 128, 128, {0, 0, 0}}, Bar{81, 90, 240, {255, 0, 0}},
        Bar{145, 54, 34, {0, 255, 0}}, Bar{41, 240, 110, {0, 0, 255}}, Bar{210, 16, 146, {255, 255, 0}}}) {
    const Picture rgb =
        converted(layout_of(PixelFormat::yuyv, 2, 1), {bar.y, bar.cb, bar.y, bar.cr}, Channels::rgb);
    CAPTURE(int{bar.y});
    CHECK(distance(pixel_of(rgb, 0), bar.rgb) <= 2);
    CHECK(pixel_of(rgb, 0) == pixel_of(rgb, 1));
  }
}

TEST_CASE(
    "each pixel of a YUYV picture has its own luma and the differences of its pair, whatever lies behind "
    "rows",
    "[camera][pixels]") {
  for (const std::size_t width : {1U, 2U, 5U, 16U}) {
    const Layout layout = layout_of(PixelFormat::yuyv, width, 3, 7);
    const Picture raw = random_bytes(bytes_of_picture(layout), 1);
    const Picture rgb = converted(layout, raw, Channels::rgb);
    const Picture grey = converted(layout, raw, Channels::grey);
    for (std::size_t y = 0; y < 3; ++y)
      for (std::size_t x = 0; x < width; ++x) {
        const std::uint8_t* const pair = &raw[y * layout.step + 4 * (x / 2)];
        const int luma = pair[2 * (x % 2)];
        CHECK(distance(pixel_of(rgb, y * width + x), rgb_of({false}, luma, pair[1], pair[3])) <= 1);
        CHECK(grey[y * width + x] == rgb_of({false}, luma, 128, 128)[0]);
      }
  }
}

TEST_CASE("each pixel of an NV12 picture has its own luma and the differences of its square of four",
          "[camera][pixels]") {
  for (const std::size_t size : {2U, 3U, 7U}) {
    const Layout layout = layout_of(PixelFormat::nv12, size, size, 5, true);
    const Picture raw = random_bytes(bytes_of_picture(layout), 2);
    const Picture rgb = converted(layout, raw, Channels::rgb);
    const Picture grey = converted(layout, raw, Channels::grey);
    for (std::size_t y = 0; y < size; ++y)
      for (std::size_t x = 0; x < size; ++x) {
        const int luma = raw[y * layout.step + x];
        const std::uint8_t* const pair = &raw[(size + y / 2) * layout.step + 2 * (x / 2)];
        CHECK(distance(pixel_of(rgb, y * size + x), rgb_of({true}, luma, pair[0], pair[1])) <= 1);
        CHECK(grey[y * size + x] == luma);
      }
  }
}

TEST_CASE("RGB stays, BGR is turned round, and both become grey by the weights of BT.601",
          "[camera][pixels]") {
  for (const PixelFormat format : {PixelFormat::rgb24, PixelFormat::bgr24}) {
    const Layout layout = layout_of(format, 5, 4, 3);
    const Picture raw = random_bytes(bytes_of_picture(layout), 3);
    const Picture rgb = converted(layout, raw, Channels::rgb);
    const Picture grey = converted(layout, raw, Channels::grey);
    for (std::size_t i = 0; i < 20; ++i) {
      const std::uint8_t* const from = &raw[i / 5 * layout.step + i % 5 * 3];
      const bool turned = format == PixelFormat::bgr24;
      const Pixel expected{from[turned ? 2 : 0], from[1], from[turned ? 0 : 2]};
      CHECK(pixel_of(rgb, i) == expected);
      const double light = 0.299 * expected[0] + 0.587 * expected[1] + 0.114 * expected[2];
      CHECK(std::abs(grey[i] - light) <= 0.51);
    }
  }
}

TEST_CASE("GREY stays, or becomes three equal colours", "[camera][pixels]") {
  const Layout layout = layout_of(PixelFormat::grey, 3, 2, 1, true);
  const Picture raw{0, 100, 255, 9, 7, 8, 200};
  CHECK(converted(layout, raw, Channels::grey) == Picture{0, 100, 255, 7, 8, 200});
  const Picture rgb = converted(layout, raw, Channels::rgb);
  CHECK(pixel_of(rgb, 1) == Pixel{100, 100, 100});
  CHECK(pixel_of(rgb, 5) == Pixel{200, 200, 200});
}

TEST_CASE(
    "a picture that lacks a byte is refused and nothing is written; what lies behind its last row may be "
    "missing",
    "[camera][pixels]") {
  for (const PixelFormat format :
       {PixelFormat::grey, PixelFormat::yuyv, PixelFormat::nv12, PixelFormat::rgb24, PixelFormat::bgr24}) {
    for (const std::size_t width : {1U, 4U, 5U}) {
      const Layout layout = layout_of(format, width, 3, 2);
      const Picture raw(bytes_of_picture(layout), 1);
      Picture into(width * 9, 77);
      CHECK(convert(layout, raw, Channels::rgb, into));
      Picture untouched(width * 9, 77);
      CHECK_FALSE(convert(layout, std::span(raw).first(raw.size() - 1), Channels::rgb, untouched));
      CHECK_FALSE(convert(layout, raw, Channels::rgb, std::span(untouched).first(width * 9 - 1)));
      Layout narrow = layout;
      narrow.step = least_step(layout) - 1;
      CHECK_FALSE(convert(narrow, raw, Channels::rgb, untouched));
      CHECK(untouched == Picture(width * 9, 77));
    }
  }
}
