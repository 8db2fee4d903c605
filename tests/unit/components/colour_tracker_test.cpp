// SPDX-License-Identifier: GPL-3.0-or-later
// Where a thing of one colour is, by drawn pictures of it.
#include <catch2/catch.hpp>

#include <cmath>
#include <vector>

#include "colour_tracker/colour_finder.hpp"
#include "colour_tracker/track.hpp"
#include "orca/base/random.hpp"

using namespace orca;
using namespace orca::colour;

namespace {

constexpr Colour kOrange{255, 122, 0};
constexpr Colour kWall{196, 192, 184};
constexpr Wanted kVest{kOrange, 0.25, 1.7, 0.5};

// A grey picture on which things are painted.
struct Canvas {
  explicit Canvas(std::size_t w = 640, std::size_t h = 480) : width(w), height(h), bytes(3 * w * h) {
    fill(0, 0, w, h, kWall);
  }
  void fill(std::size_t column, std::size_t row, std::size_t end_column, std::size_t end_row, Colour colour) {
    for (std::size_t r = row; r < std::min(end_row, height); ++r)
      for (std::size_t c = column; c < std::min(end_column, width); ++c) {
        std::uint8_t* const p = bytes.data() + 3 * (r * width + c);
        p[0] = colour.red;
        p[1] = colour.green;
        p[2] = colour.blue;
      }
  }
  /// Paints an upright cylinder of 1.7 m height whose middle is there.
  void stand(double bearing, double distance, Colour colour, double radius = 0.25) {
    const double half = std::asin(radius / distance);
    const double depth = (distance - radius) * std::cos(bearing);
    const auto column = [&](double angle) {
      return static_cast<std::size_t>(
          std::lround(std::clamp(0.5 * double(width) - focal_length * std::tan(angle), 0.0, double(width))));
    };
    const auto row = [&](double high) {
      return static_cast<std::size_t>(
          std::lround(std::clamp(0.5 * double(height) - focal_length * high / depth, 0.0, double(height))));
    };
    fill(column(bearing + half), row(1.7 - 0.5), column(bearing - half), row(-0.5), colour);
  }
  [[nodiscard]] std::optional<Sighting> find(const Wanted& wanted = kVest) const {
    return find_colour({bytes, width, height, 3 * width, focal_length}, wanted);
  }
  std::size_t width, height;
  double focal_length = 300.0;
  std::vector<std::uint8_t> bytes;
};

}  // namespace

TEST_CASE("a thing is found where it is, near and far, ahead and aside", "[colour]") {
  for (const double distance : {1.2, 1.6, 2.0, 4.0, 7.0})
    for (const double bearing : {-0.6, -0.2, 0.0, 0.3, 0.55}) {
      Canvas canvas;
      canvas.stand(bearing, distance, kOrange);
      const auto sighting = canvas.find();
      CAPTURE(distance, bearing);
      REQUIRE(sighting);
      CHECK(std::fabs(sighting->bearing - bearing) < 0.005);
      CHECK(std::fabs(sighting->distance - distance) < 0.05 * distance);
    }
}

TEST_CASE("shade does not matter, and other colours are no match", "[colour]") {
  Canvas shady;
  shady.stand(0.1, 2.0, {140, 67, 0});
  CHECK(shady.find());
  for (const Colour other : {Colour{72, 78, 96}, Colour{200, 40, 30}, Colour{250, 220, 0},
                             Colour{120, 110, 98}, Colour{36, 36, 38}}) {
    Canvas canvas;
    canvas.stand(0.1, 2.0, other);
    CHECK_FALSE(canvas.find());
  }
  CHECK_FALSE(Canvas().find());
}

TEST_CASE("of two things of the colour the larger one counts", "[colour]") {
  Canvas canvas;
  canvas.stand(0.4, 5.0, kOrange);
  canvas.stand(-0.4, 2.0, kOrange);
  REQUIRE(canvas.find());
  CHECK(canvas.find()->bearing < -0.35);
}

TEST_CASE("where a side is hidden or cut off, the foot says how far it is", "[colour]") {
  Canvas hidden;
  hidden.stand(0.0, 2.0, kOrange);
  hidden.fill(0, 0, 315, 480, kWall);  // A door post before the greater part of it.
  REQUIRE(hidden.find());
  CHECK(std::fabs(hidden.find()->distance - 2.0) < 0.15);

  Canvas cut;
  cut.stand(std::atan(320.0 / 300.0), 2.0, kOrange);  // Half of it is beyond the left edge.
  REQUIRE(cut.find());
  CHECK(std::fabs(cut.find()->distance - 2.0) < 0.2);
}

TEST_CASE("pictures of any size and content are looked at within their bytes", "[colour]") {
  RandomStream random(7, "pictures", "bytes");
  for (int i = 0; i < 300; ++i) {
    const auto width = static_cast<std::size_t>(random.uniform(1.0, 900.0));
    const auto height = static_cast<std::size_t>(random.uniform(1.0, 40.0));
    std::vector<std::uint8_t> bytes(3 * width * height);
    for (std::uint8_t& byte : bytes) byte = static_cast<std::uint8_t>(random.uniform(0.0, 256.0));
    const auto sighting = find_colour({bytes, width, height, 3 * width, random.uniform(1.0, 2000.0)}, kVest);
    if (sighting) CHECK((std::isfinite(sighting->distance) && sighting->distance > 0.0));
  }
}

TEST_CASE("a track follows who walks, and says how wrong it may be", "[colour]") {
  RandomStream random(3, "track", "noise");
  Track track;
  double worst = 0.0;
  int within = 0;
  constexpr int kSightings = 300;
  for (int i = 0; i < kSightings; ++i) {
    const double time = 0.0333 * i;
    const Vec2 true_place{0.8 * time, 1.0 - 0.3 * time};
    track.see({true_place.x + random.normal(0.0, 0.06), true_place.y + random.normal(0.0, 0.06)}, 0.06, time);
    if (i < 60) continue;
    worst = std::max(worst, norm(track.velocity() - Vec2{0.8, -0.3}));
    within += std::fabs(track.place().x - true_place.x) < 2.0 * track.place_error();
  }
  CHECK(worst < 0.4);
  CHECK(within > 0.9 * (kSightings - 60));
}

TEST_CASE("out of sight somebody goes on as he went, and is forgotten after two seconds", "[colour]") {
  Track track;
  for (int i = 0; i <= 30; ++i) track.see({0.1 * i, 0.0}, 0.03, 0.1 * i);
  track.miss(4.0);
  CHECK(track.is_there());
  CHECK(std::fabs(track.place().x - 4.0) < 0.1);
  CHECK(std::fabs(track.unseen() - 1.0) < 1e-9);
  track.miss(5.1);
  CHECK_FALSE(track.is_there());
  track.see({9.0, 9.0}, 0.03, 5.2);
  CHECK(track.velocity() == Vec2{});
}

TEST_CASE("a sighting that cannot be is not believed for half a second", "[colour]") {
  Track track;
  for (int i = 0; i <= 30; ++i) track.see({0.05 * i, 0.0}, 0.03, 0.1 * i);
  track.miss(3.1);
  CHECK(track.admits({1.6, 0.1}, 0.05));
  CHECK_FALSE(track.admits({3.5, 1.0}, 0.05));
  track.miss(3.6);
  CHECK(track.admits({3.5, 1.0}, 0.05));
}
