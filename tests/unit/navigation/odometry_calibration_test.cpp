// SPDX-License-Identifier: GPL-3.0-or-later
#include "orca/navigation/odometry_calibration.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>
#include <vector>

#include "orca/base/random.hpp"
#include "orca/geometry/arc.hpp"

using namespace orca;
using namespace orca::nav;

namespace {

constexpr double kTrack = 0.33;  // [m] as the controller believes

/// A differential base with wrong wheels, and how well something sees where it is.
struct Cart {
  double mismatch = 0.0;   // right diameter less left, over their mean
  double size = 0.0;       // of both wheels: relative error
  double wide = 0.0;       // true track over kTrack, less 1
  double slip = 0.0;       // [m] of a wheel after 1 m
  double turn_slip = 0.0;  // [m] of a wheel after 1 rad
  double place = 0.0;      // [m] deviation of the poses seen
  double turn = 0.0;       // [rad] the same
};

// Where the base truly goes when its controller counts a motion.
Travel2 truth_of(const Cart& cart, const Travel2& counted, RandomStream& random) {
  const double lever = 0.5 * kTrack * counted.turn;
  const auto wheel = [&](double rolled, double factor) {
    const double variance =
        cart.slip * cart.slip * std::fabs(rolled) + cart.turn_slip * cart.turn_slip * std::fabs(counted.turn);
    return factor * rolled + random.normal(0.0, std::sqrt(variance));
  };
  const double left = wheel(counted.forward - lever, (1.0 + cart.size) * (1.0 - 0.5 * cart.mismatch));
  const double right = wheel(counted.forward + lever, (1.0 + cart.size) * (1.0 + 0.5 * cart.mismatch));
  return {0.5 * (left + right), 0.0, (right - left) / (kTrack * (1.0 + cart.wide))};
}

// A drive through rooms: legs of some metres, and turns on the spot to both sides. A pose is seen every 0.25 m and every 0.1 rad.
std::vector<DrivenPiece> drive(const Cart& cart, double metres, std::uint64_t seed) {
  RandomStream random(seed, "test", "drive");
  std::vector<DrivenPiece> pieces;
  Pose2 X_WB;
  Pose2 seen;
  const auto roll = [&](const Travel2& counted) {
    X_WB = along_arc(X_WB, truth_of(cart, counted, random));
    const Pose2 next = X_WB * Pose2{random.normal(0.0, cart.place), random.normal(0.0, cart.place),
                                    random.normal(0.0, cart.turn)};
    pieces.push_back({counted.forward, counted.turn, std::fabs(counted.forward), std::fabs(counted.turn),
                      seen_from(seen, next)});
    seen = next;
  };
  for (double way = 0.0; way < metres;) {
    for (int i = 0; i < 16; ++i, way += 0.25) roll({0.25, 0.0, random.normal(0.0, 0.02)});
    const double side = random.uniform(-1.0, 1.0) > 0.0 ? 1.0 : -1.0;
    const int steps = 10 + static_cast<int>(random.uniform(0.0, 30.0));
    for (int i = 0; i < steps; ++i) roll({0.0, 0.0, 0.1 * side});
  }
  return pieces;
}

OdometryCalibration found(const Cart& cart, double metres, std::uint64_t seed = 1) {
  const Result<OdometryCalibration> result = calibrate(drive(cart, metres, seed), kTrack);
  INFO((result ? "" : result.error().message));
  REQUIRE(result);
  return *result;
}

}  // namespace

TEST_CASE("a calibration without noise is what the wheels are", "[navigation][calibration]") {
  const OdometryCalibration result = found({.mismatch = 0.01, .size = -0.015, .wide = 0.02}, 100.0);
  CHECK(result.wheel_ratio(kTrack) == Approx(1.005 / 0.995).epsilon(1e-6));
  CHECK(result.track_ratio() == Approx(1.02).epsilon(1e-6));
  CHECK(result.distance_scale.value == Approx(0.985).epsilon(1e-6));
}

TEST_CASE("wheels unlike by 1 % and a track off by 2 % are found within 0.1 % from what scans say",
          "[navigation][calibration]") {
  // Scans lie within 1 cm and 0.3 degrees, the wheels slip by 1 mm a metre, on 500 m.
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    const OdometryCalibration result =
        found({.mismatch = 0.01, .wide = 0.02, .slip = 0.001, .place = 0.01, .turn = 0.005}, 500.0, seed);
    CAPTURE(seed, result.turn_scale.deviation, result.turn_per_metre.deviation);
    CHECK(std::fabs(result.wheel_ratio(kTrack) - 1.01) < 0.001);
    CHECK(std::fabs(result.track_ratio() - 1.02) < 0.001);
    CHECK(std::fabs(result.distance_scale.value - 1.0) < 0.001);
  }
}

TEST_CASE("a deviation says how far a figure is off, with the slip of a real base",
          "[navigation][calibration]") {
  const Cart cart{
      .mismatch = 0.01, .wide = 0.02, .slip = 0.003, .turn_slip = 0.003, .place = 0.01, .turn = 0.005};
  int within = 0;
  constexpr int kDrives = 40;
  for (std::uint64_t seed = 1; seed <= kDrives; ++seed) {
    const OdometryCalibration result = found(cart, 200.0, seed);
    const auto count = [&within](double off, double deviation) {
      within += std::fabs(off) < 2.0 * deviation ? 1 : 0;
    };
    count(result.turn_scale.value - 1.0 / 1.02, result.turn_scale.deviation);
    count(result.turn_per_metre.value - 0.01 / (1.02 * kTrack), result.turn_per_metre.deviation);
    count(result.distance_scale.value - 1.0, result.distance_scale.deviation);
  }
  // 95 % are expected.
  CHECK(within >= 3 * kDrives * 92 / 100);
}

TEST_CASE("slip is found beside the errors of the poses", "[navigation][calibration]") {
  const Cart cart{.slip = 0.003, .turn_slip = 0.004, .place = 0.01, .turn = 0.005};
  double slip = 0.0;
  double turn_slip = 0.0;
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    const OdometryCalibration result = found(cart, 500.0, seed);
    slip += result.left.slip / 10.0;
    turn_slip += result.left.turn_slip / 10.0;
  }
  CHECK(slip == Approx(0.003).epsilon(0.25));
  CHECK(turn_slip == Approx(0.004).epsilon(0.25));
}

TEST_CASE("poses that are quite wrong now and then change little", "[navigation][calibration]") {
  std::vector<DrivenPiece> pieces =
      drive({.mismatch = 0.01, .wide = 0.02, .slip = 0.001, .place = 0.01, .turn = 0.005}, 500.0, 3);
  for (std::size_t i = 0; i < pieces.size(); i += 50) pieces[i].X_AB = pieces[i].X_AB * Pose2{0.5, 0.2, 0.4};
  const Result<OdometryCalibration> result = calibrate(pieces, kTrack);
  REQUIRE(result);
  CHECK(std::fabs(result->wheel_ratio(kTrack) - 1.01) < 0.003);
  CHECK(std::fabs(result->track_ratio() - 1.02) < 0.003);
}

TEST_CASE("a drive that shows too little is refused", "[navigation][calibration]") {
  CHECK(calibrate({}, kTrack).error().code == Code::failed_precondition);
  std::vector<DrivenPiece> straight(1000, DrivenPiece{0.25, 0.0, 0.25, 0.0, {0.25, 0.0, 0.0}});
  CHECK_FALSE(calibrate(straight, kTrack));
  std::vector<DrivenPiece> circle(1000,
                                  DrivenPiece{0.25, 0.25, 0.25, 0.25, along_arc({}, {0.25, 0.0, 0.25})});
  CHECK_THAT(calibrate(circle, kTrack).error().message, Catch::Contains("does not tell way from turn"));
}

TEST_CASE("counts add up between readings, in proportion", "[navigation][calibration]") {
  CountHistory history;
  history.add(TimePoint(1s), {});
  history.add(TimePoint(2s), {1.0, 0.0, 0.0});
  history.add(TimePoint(3s), {1.0, 0.0, 3.0});
  history.add(TimePoint(4s), {1.0, 0.0, -0.5});  // on to the left, by 2.78 rad
  CHECK_FALSE(history.at(TimePoint(500ms)));
  CHECK_FALSE(history.at(TimePoint(5s)));
  CHECK(history.at(TimePoint(1500ms))->way == Approx(0.5));
  CHECK(history.at(TimePoint(1500ms))->X_OB.x == Approx(0.5));
  CHECK(history.at(TimePoint(4s))->turn == Approx(2.0 * std::numbers::pi - 0.5));
  const DrivenPiece piece =
      piece_between(*history.at(TimePoint(1s)), *history.at(TimePoint(3s)), {1.0, 0.0, 3.0});
  CHECK(piece.way == Approx(1.0));
  CHECK(piece.turned == Approx(3.0));
}

TEST_CASE("squares driven both ways round show unlike wheels and a wrong track",
          "[navigation][calibration]") {
  const Cart cart{.mismatch = 0.01, .wide = 0.02};
  // Returns what the controller counts while the base moves so.
  const auto counted_of = [&](const Travel2& real) {
    const double lever = 0.5 * kTrack * (1.0 + cart.wide) * real.turn;
    const double left = (real.forward - lever) / (1.0 - 0.5 * cart.mismatch);
    const double right = (real.forward + lever) / (1.0 + 0.5 * cart.mismatch);
    return Travel2{0.5 * (left + right), 0.0, (right - left) / kTrack};
  };
  std::vector<SquareEnd> squares;
  for (const bool clockwise : {false, true}) {
    Pose2 counted;
    for (int leg = 0; leg < 4; ++leg) {
      counted = along_arc(counted, counted_of({4.0, 0.0, 0.0}));
      counted = along_arc(counted, counted_of({0.0, 0.0, (clockwise ? -0.5 : 0.5) * std::numbers::pi}));
    }
    for (int i = 0; i < 5; ++i) squares.push_back({clockwise, -1.0 * counted.position()});
  }
  const auto result = evaluate_squares(squares, 4.0, kTrack);
  REQUIRE(result);
  // Unlike wheels also drive on a little while they turn on the spot, which the formulas leave out.
  CHECK(result->wheel_ratio == Approx(1.005 / 0.995).epsilon(1e-4));
  CHECK(result->track_ratio == Approx(1.02).epsilon(1e-4));
  CHECK(result->error > 0.2);
  CHECK_FALSE(evaluate_squares(std::span(squares).first(5), 4.0, kTrack));
}
