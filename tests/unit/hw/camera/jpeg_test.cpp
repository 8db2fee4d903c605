// SPDX-License-Identifier: GPL-3.0-or-later
// Pictures of Motion JPEG, whole and broken.
#include <catch2/catch.hpp>

#include <algorithm>
#include <chrono>
#include <functional>
#include <iostream>
#include <random>

#include "jpeg_picture.hpp"
#include "orca/hw/camera/jpeg_decoder.hpp"
#include "slow_run.hpp"

using namespace orca;
using namespace orca::test;
using Catch::Contains;
using hw::camera::Channels;
using hw::camera::JpegDecoder;

namespace {

using Picture = std::vector<std::uint8_t>;
constexpr std::size_t kWidth = 48;
constexpr std::size_t kHeight = 32;

Status decode(JpegDecoder& decoder, const Picture& jpeg, Picture& into, Channels channels = Channels::rgb) {
  into.assign(kWidth * kHeight * static_cast<std::size_t>(channels), 0);
  return decoder.decode(jpeg, kWidth, kHeight, channels, into);
}

// Three values are rounded on the way there and three on the way back, and 1.772 is the largest factor.
constexpr int kRounding = 2;

// Whether the pixel lies beside the edge of a square, where colours of half the resolution are mixed.
bool is_at_edge(std::size_t pixel) {
  const std::size_t x = pixel % kWidth % 16;
  const std::size_t y = pixel / kWidth % 16;
  return x == 0 || x == 15 || y == 0 || y == 15;
}

bool are_alike(const Picture& a, const Picture& b) {
  const std::size_t channels = a.size() / (kWidth * kHeight);
  if (a.size() != b.size()) return false;
  for (std::size_t i = 0; i < a.size(); ++i)
    if (!is_at_edge(i / channels) && std::abs(a[i] - b[i]) > kRounding) return false;
  return true;
}

Picture good() { return jpeg_of(squares(kWidth, kHeight), kWidth, kHeight); }

void check_still_works(JpegDecoder& decoder) {
  Picture rgb;
  CHECK(decode(decoder, good(), rgb).ok());
  CHECK(are_alike(rgb, squares(kWidth, kHeight)));
}

}  // namespace

TEST_CASE("a picture comes out of Motion JPEG as it went in, one after the other", "[camera][jpeg]") {
  JpegDecoder decoder;
  for (unsigned seed = 0; seed < 5; ++seed) {
    const Picture original = squares(kWidth, kHeight, seed);
    Picture rgb;
    CHECK(decode(decoder, jpeg_of(original, kWidth, kHeight), rgb).ok());
    CHECK(are_alike(rgb, original));
  }
}

TEST_CASE("the Huffman tables may be missing", "[camera][jpeg]") {
  JpegDecoder decoder;
  Picture with;
  Picture without;
  CHECK(without_tables(good()).size() < good().size());
  CHECK(decode(decoder, good(), with).ok());
  CHECK(decode(decoder, without_tables(good()), without).ok());
  CHECK(with == without);
}

TEST_CASE("brightness alone comes from pictures in colour, and colours from grey pictures",
          "[camera][jpeg]") {
  JpegDecoder decoder;
  const Picture rgb = squares(kWidth, kHeight);
  Picture grey;
  CHECK(decode(decoder, good(), grey, Channels::grey).ok());
  Picture expected;
  for (std::size_t i = 0; i < rgb.size(); i += 3)
    expected.push_back(
        static_cast<std::uint8_t>(0.299 * rgb[i] + 0.587 * rgb[i + 1] + 0.114 * rgb[i + 2] + 0.5));
  CHECK(are_alike(grey, expected));
  Picture coloured;
  CHECK(decode(decoder, jpeg_of(expected, kWidth, kHeight, {.grey = true}), coloured).ok());
  Picture three;
  for (const std::uint8_t value : expected) three.insert(three.end(), 3, value);
  CHECK(are_alike(coloured, three));
}

TEST_CASE("bytes behind a picture, and too many before its end, do no harm", "[camera][jpeg]") {
  JpegDecoder decoder;
  Picture rgb;
  Picture padded = good();
  padded.resize(padded.size() + 500, 0);
  CHECK(decode(decoder, padded, rgb).ok());
  Picture late = good();
  late.insert(late.end() - 2, 3, 0);
  CHECK(decode(decoder, late, rgb).ok());
  CHECK(are_alike(rgb, squares(kWidth, kHeight)));
}

TEST_CASE("a picture that is cut off anywhere is an error, and the next one is whole", "[camera][jpeg]") {
  JpegDecoder decoder;
  const Picture whole = good();
  const std::size_t step = is_slow_run() ? 1 : 13;
  for (std::size_t length = 0; length + 2 < whole.size(); length += step) {
    Picture rgb;
    const Status cut = decode(decoder, Picture(whole.begin(), whole.begin() + length), rgb);
    CAPTURE(length);
    REQUIRE_FALSE(cut.ok());
    CHECK(cut.error().code == Code::data_loss);
    CHECK_FALSE(cut.error().message.empty());
  }
  check_still_works(decoder);
}

TEST_CASE("a picture of another size, a progressive one and what is none are refused", "[camera][jpeg]") {
  JpegDecoder decoder;
  Picture rgb;
  const Status large = decode(decoder, jpeg_of(squares(64, 64), 64, 64), rgb);
  CHECK_THAT(large.error().message, Contains("another size"));
  const Status progressive =
      decode(decoder, jpeg_of(squares(kWidth, kHeight), kWidth, kHeight, {.progressive = true}), rgb);
  CHECK_THAT(progressive.error().message, Contains("progressive"));
  CHECK(decode(decoder, Picture(1000, 0x55), rgb).error().code == Code::data_loss);
  Picture small(10);
  CHECK(decoder.decode(good(), kWidth, kHeight, Channels::rgb, small).error().code == Code::invalid_argument);
  check_still_works(decoder);
}

TEST_CASE("whatever bytes are spoiled, a picture is decoded or refused, and the next one is whole",
          "[camera][jpeg]") {
  JpegDecoder decoder;
  std::mt19937 random(7);
  const Picture whole = good();
  int refused = 0;
  for (int i = 0; i < part_of(3000); ++i) {
    Picture spoiled = whole;
    for (unsigned k = random() % 8 + 1; k > 0; --k)
      spoiled[random() % spoiled.size()] = static_cast<std::uint8_t>(random());
    Picture rgb;
    refused += !decode(decoder, spoiled, rgb).ok();
  }
  CHECK(refused > 0);
  check_still_works(decoder);
}

namespace {

// Returns the time that one call takes, the median of some [ms].
double milliseconds(const std::function<void()>& body) {
  std::vector<double> times;
  for (int i = 0; i < 15; ++i) {
    const auto begin = std::chrono::steady_clock::now();
    body();
    times.push_back(
        std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - begin).count());
  }
  std::ranges::nth_element(times, times.begin() + 7);
  return times[7];
}

}  // namespace

TEST_CASE("a picture of 1280 x 720 pixels is developed in half the time until the next one comes at 30 Hz",
          "[camera][jpeg][quiet]") {
  constexpr std::size_t kPixels = std::size_t{1280} * 720;
  Picture noisy = squares(1280, 720);
  std::mt19937 random(1);
  for (std::uint8_t& value : noisy) value = static_cast<std::uint8_t>(value + random() % 8);
  const Picture jpeg = jpeg_of(noisy, 1280, 720, {.quality = 85});
  const Picture yuyv(2 * kPixels, 100);
  Picture into(3 * kPixels);
  JpegDecoder decoder;
  const double of_jpeg =
      milliseconds([&] { REQUIRE(decoder.decode(jpeg, 1280, 720, Channels::rgb, into).ok()); });
  const double of_yuyv = milliseconds([&] {
    REQUIRE(convert({hw::camera::PixelFormat::yuyv, 1280, 720, 2560}, yuyv, Channels::rgb, into));
  });
  std::cout << "1280 x 720 to RGB8: MJPG of " << jpeg.size() / 1000 << " kB " << of_jpeg << " ms, YUYV "
            << of_yuyv << " ms\n";
#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)  // they check each byte of a picture
  CHECK(of_jpeg < 0.5 * 1000.0 / 30.0);
  CHECK(of_yuyv < 0.5 * 1000.0 / 30.0);
#endif
}
