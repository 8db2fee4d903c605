// SPDX-License-Identifier: GPL-3.0-or-later
// A square driven exactly, as the odometry of a robot with known wheel errors sees it (after the UMBmark of
// Borenstein and Feng, IEEE Trans. Robotics and Automation 12(6), 1996).
#include <catch2/catch.hpp>

#include <complex>

#include "bases.hpp"
#include "motion/odometry_model.hpp"

using namespace orca::sim;
using orca::Pose2;
using orca::Twist2;
using namespace orca::sim::test;
using orca::Travel2;
using orca::sim::detail::OdometryModel;
using orca::sim::detail::WheelErrors;

namespace {

using Complex = std::complex<double>;
constexpr double kLeg = 4.0;    // [m]
constexpr double kTrack = 0.4;  // [m]
constexpr double kQuarter = 0.5 * std::numbers::pi;

Drive drive_of(DriveKind kind) { return {.kind = kind, .track = kTrack, .wheel_diameter = 0.15}; }

// Adds a motion in small steps, as a simulation does.
void add(OdometryModel& odometry, const Travel2& whole) {
  constexpr int kSteps = 1000;
  for (int i = 0; i < kSteps; ++i)
    odometry.add({whole.forward / kSteps, whole.left / kSteps, whole.turn / kSteps}, 0.01);
}

// Returns the pose that the odometry reports after a square. @param turn  at each corner: +-90 deg.
Pose2 believed_end(DriveKind kind, const WheelErrors& errors, double turn, std::uint64_t seed = 1) {
  OdometryModel odometry(drive_of(kind), errors, orca::RandomStream(seed, "dewey", "odometry"));
  for (int corner = 0; corner < 4; ++corner) {
    add(odometry, {kLeg, 0.0, 0.0});
    add(odometry, {0.0, 0.0, turn});
  }
  return odometry.reading({}).pose;
}

// The end of an arc: the integral of a direction that turns evenly.
Complex arc(double travel, double turn) {
  if (turn == 0.0) return travel;
  return travel * (std::exp(Complex(0.0, turn)) - 1.0) / Complex(0.0, turn);
}

// The same square in closed form; `left`, `right` and `track` are the relative errors of wheels and track.
Complex end_of_square(double left, double right, double track, double turn) {
  Complex end = 0.0;
  Complex heading = 1.0;
  const auto go = [&](double l, double r) {
    const double believed_turn = (r - l) / (kTrack * (1.0 + track));
    end += heading * arc(0.5 * (l + r), believed_turn);
    heading *= std::exp(Complex(0.0, believed_turn));
  };
  for (int corner = 0; corner < 4; ++corner) {
    go(kLeg * (1.0 + left), kLeg * (1.0 + right));
    go(-0.5 * turn * kTrack * (1.0 + left), 0.5 * turn * kTrack * (1.0 + right));
  }
  return end;
}

}  // namespace

TEST_CASE(
    "the square of a differential base with unequal wheels and a wrong track ends where the closed form "
    "says",
    "[sim][odometry][square]") {
  const double turn = GENERATE(kQuarter, -kQuarter);
  for (const auto& [left, right, track] :
       {std::array{-0.002, 0.003, 0.0}, std::array{0.0, 0.0, 0.01}, std::array{0.005, -0.004, -0.01}}) {
    const Pose2 end = believed_end(DriveKind::differential, {{left, right}, track, 0.0}, turn);
    const Complex expected = end_of_square(left, right, track, turn);
    CHECK(end.x == Approx(expected.real()).margin(1e-9));
    CHECK(end.y == Approx(expected.imag()).margin(1e-9));
  }
}

// Type B of the UMBmark: each leg bends by b = L (right - left) / track. To first order the square ends at
// (2 L b, -2 L b) counter-clockwise and at (-2 L b, -2 L b) clockwise.
TEST_CASE("unequal wheels bend both squares to the same side, by the first-order formulas of the UMBmark",
          "[sim][odometry][square]") {
  const double mismatch = 2e-5;
  const double bend = kLeg * mismatch / kTrack;
  const WheelErrors errors{{-0.5 * mismatch, 0.5 * mismatch}, 0.0, 0.0};
  const Pose2 ccw = believed_end(DriveKind::differential, errors, kQuarter);
  const Pose2 cw = believed_end(DriveKind::differential, errors, -kQuarter);
  CHECK(ccw.x == Approx(2.0 * kLeg * bend).epsilon(0.005));
  CHECK(ccw.y == Approx(-2.0 * kLeg * bend).epsilon(0.005));
  CHECK(cw.x == Approx(-2.0 * kLeg * bend).epsilon(0.005));
  CHECK(cw.y == Approx(-2.0 * kLeg * bend).epsilon(0.005));
}

// Type A: a track that is taken too large makes each turn too small by a = track * 90 deg.
TEST_CASE("a wrong track opens both squares alike, by the first-order formulas of the UMBmark",
          "[sim][odometry][square]") {
  const double track = 2e-4;
  const double short_by = track * kQuarter;
  const Pose2 ccw = believed_end(DriveKind::differential, {{}, track, 0.0}, kQuarter);
  const Pose2 cw = believed_end(DriveKind::differential, {{}, track, 0.0}, -kQuarter);
  CHECK(ccw.x == Approx(-2.0 * kLeg * short_by).epsilon(0.005));
  CHECK(ccw.y == Approx(2.0 * kLeg * short_by).epsilon(0.005));
  CHECK(cw.x == Approx(-2.0 * kLeg * short_by).epsilon(0.005));
  CHECK(cw.y == Approx(-2.0 * kLeg * short_by).epsilon(0.005));
}

TEST_CASE("slip alone scatters the distance in proportion to the root of the way", "[sim][odometry]") {
  constexpr double kSlip = 0.003;
  constexpr int kRobots = 400;
  double squares = 0.0;
  for (int i = 0; i < kRobots; ++i) {
    OdometryModel odometry(drive_of(DriveKind::synchro), WheelErrors{{}, 0.0, kSlip},
                           orca::RandomStream(static_cast<std::uint64_t>(i), "dewey", "odometry"));
    add(odometry, {kLeg, 0.0, 0.0});
    const double off = norm(odometry.reading({}).pose.position()) - kLeg;
    squares += off * off;
  }
  // The mean of three wheels; 400 samples give the deviation within 10 % (three sigma).
  const double expected = kSlip * std::sqrt(kLeg / 3.0);
  CHECK(std::sqrt(squares / kRobots) == Approx(expected).epsilon(0.11));
}

TEST_CASE("a synchro base steers exactly, and only its distance is wrong, by the mean of its wheels",
          "[sim][odometry][square]") {
  const WheelErrors errors{{0.004, 0.001, -0.002}, 0.01, 0.0};
  OdometryModel odometry(drive_of(DriveKind::synchro), errors, orca::RandomStream(1, "dewey", "odometry"));
  add(odometry, {kLeg, 0.0, 0.0});
  CHECK(odometry.reading({}).pose.x == Approx(kLeg * 1.001));
  add(odometry, {0.0, 0.0, kQuarter});
  CHECK(odometry.reading({}).pose.yaw == Approx(kQuarter));
  const Pose2 end = believed_end(DriveKind::synchro, errors, kQuarter);
  CHECK(norm(end.position()) < 1e-9);  // A closed square stays closed when only its size is wrong.
}

// Wheels at 60, 180 and 300 degrees; one that is e too large adds e (d . v) of the way in direction d, times
// 2/3, and turns by e (d . v) / (3 radius).
TEST_CASE("one wrong wheel of a holonomic base drags it along its own direction", "[sim][odometry]") {
  constexpr double kError = 1e-3;
  OdometryModel odometry(drive_of(DriveKind::holonomic), WheelErrors{{0.0, kError, 0.0}, 0.0, 0.0},
                         orca::RandomStream(1, "dewey", "odometry"));
  odometry.add({0.3, -0.2, 0.0}, 1.0);  // The second wheel, at the back, rolls to the right.
  const double rolled = 0.2 * kError;
  const Twist2 believed = odometry.reading({}).velocity;
  CHECK(believed.forward == Approx(0.3));
  CHECK(believed.left == Approx(-0.2 - 2.0 / 3.0 * rolled));
  CHECK(believed.turn_rate == Approx(rolled / (1.5 * kTrack)));
}

TEST_CASE("the odometry of a holonomic base with too large a wheel circle turns too little",
          "[sim][odometry]") {
  OdometryModel odometry(drive_of(DriveKind::holonomic), WheelErrors{{}, 0.02, 0.0},
                         orca::RandomStream(1, "dewey", "odometry"));
  add(odometry, {0.0, 0.0, kQuarter});
  CHECK(odometry.reading({}).pose.yaw == Approx(kQuarter / 1.02));
}
