// SPDX-License-Identifier: GPL-3.0-or-later
// A square whose encoders report it exactly, and where a robot with unlike wheels ends it (the UMBmark of J. Borenstein
// and L. Feng, "Measurement and correction of systematic odometry errors in mobile robots", IEEE Trans. Robotics and
// Automation 12(6), 1996).
#include <catch2/catch.hpp>

#include "motion/wheel_model.hpp"
#include "orca/geometry/arc.hpp"
#include "square.hpp"

using namespace orca::sim;
using orca::Pose2;
using orca::RandomStream;
using orca::Travel2;
using orca::sim::detail::WheelErrors;
using orca::sim::detail::WheelModel;
using orca::sim::test::end_of_square;

namespace {

constexpr double kLeg = 4.0;    // [m]
constexpr double kTrack = 0.4;  // [m]
constexpr double kQuarter = 0.5 * std::numbers::pi;

orca::sim::Drive drive_of(DriveKind kind) { return {.kind = kind, .track = kTrack, .wheel_diameter = 0.15}; }

// A base that drives by its encoders, in small steps, as a simulation does.
class Base {
 public:
  Base(DriveKind kind, const WheelErrors& errors, std::uint64_t seed = 1)
      : kind_(kind), wheels_(drive_of(kind), errors), random_(seed, "dewey", "wheels") {}

  void roll(const Travel2& whole, int steps = 1000) {
    for (int i = 0; i < steps; ++i) {
      const Travel2 step{whole.forward / steps, whole.left / steps, whole.turn / steps};
      const Travel2 real = wheels_.over_ground(step, steering_, {}, random_);
      pose_ = orca::along_arc(pose_, real);
      if (kind_ == DriveKind::synchro) steering_ += step.turn;
      unseen_ = std::max(unseen_, apart(wheels_.rolled(real), step));
    }
  }
  void square(double turn, int steps) {
    for (int corner = 0; corner < 4; ++corner) {
      roll({kLeg, 0.0, 0.0}, steps);
      roll({0.0, 0.0, turn}, steps);
    }
  }
  [[nodiscard]] const Pose2& pose() const { return pose_; }
  // How far what the encoders report of the true motion was off what they were told to roll.
  [[nodiscard]] double unseen() const { return unseen_; }

 private:
  double apart(const Travel2& a, const Travel2& b) const {
    const double turn =
        kind_ == DriveKind::synchro ? 0.0 : a.turn - b.turn;  // its steering is seen elsewhere
    return std::fabs(a.forward - b.forward) + std::fabs(a.left - b.left) + std::fabs(turn);
  }

  DriveKind kind_;
  WheelModel wheels_;
  RandomStream random_;
  Pose2 pose_;
  double steering_ = 0.0;
  double unseen_ = 0.0;
};

Pose2 end_of_drive(DriveKind kind, const WheelErrors& errors, double turn, std::uint64_t seed = 1,
                   int steps = 1000) {
  Base base(kind, errors, seed);
  base.square(turn, steps);
  return base.pose();
}

// What the UMBmark finds: E_d, the ratio of right diameter to left, and E_b, the ratio of true track to assumed.
struct Calibration {
  double ratio = 1.0;
  double track = 1.0;
  double scatter = 0.0;  // [m2] variance of the ends of single squares along x
};

constexpr int kRuns = 5;
constexpr int kStepsOfRoll = 100;  // of each leg and turn

// The experiment and its evaluation: five squares each way, whose ends are averaged.
Calibration umbmark(const WheelErrors& errors, std::uint64_t seed) {
  std::array<double, 2> mean{};
  double squares = 0.0;
  for (const std::size_t way : {0U, 1U}) {
    std::array<double, kRuns> ends{};
    for (std::uint64_t run = 0; run < kRuns; ++run) {
      const double turn = way == 0 ? kQuarter : -kQuarter;
      ends[run] =
          end_of_drive(DriveKind::differential, errors, turn, 1000 * seed + 2 * run + way, kStepsOfRoll).x;
      mean[way] += ends[run] / kRuns;
    }
    for (const double end : ends) squares += std::pow(end - mean[way], 2);
  }
  const auto [ccw, cw] = mean;
  const double alpha = (cw + ccw) / (-4.0 * kLeg);
  const double beta = (cw - ccw) / (-4.0 * kLeg);
  const double radius = 0.5 * kLeg / std::sin(0.5 * beta);
  return {(radius + 0.5 * kTrack) / (radius - 0.5 * kTrack), kQuarter / (kQuarter - alpha),
          squares / (2 * (kRuns - 1))};
}

// The errors that are left once the controller assumes what was found, without slip.
WheelErrors left_after(const WheelErrors& errors, const Calibration& found) {
  const double left = 2.0 / (found.ratio + 1.0);
  const double right = 2.0 / (1.0 / found.ratio + 1.0);
  return {.diameter = {(1.0 + errors.diameter[0]) / left - 1.0, (1.0 + errors.diameter[1]) / right - 1.0},
          .track = (1.0 + errors.track) / found.track - 1.0};
}

constexpr int kDrawnRobots = 200;

WheelErrors drawn(Realism level, std::uint64_t seed) {
  RandomStream random(seed, "dewey", "wheels");
  return WheelErrors::drawn(DriveKind::differential, error_levels(level), random);
}

WheelErrors without_slip(WheelErrors errors) {
  errors.slip = errors.turn_slip = 0.0;
  return errors;
}

// The measure of systematic errors: how far off the worse of the two squares ends.
double worst_end(const WheelErrors& errors) {
  const auto off = [&](double turn) { return norm(end_of_square({kLeg, turn, kTrack}, errors).position()); };
  return std::max(off(kQuarter), off(-kQuarter));
}

}  // namespace

TEST_CASE(
    "a differential base with unequal wheels and another track ends its square where the closed form says",
    "[sim][wheels][square]") {
  const double turn = GENERATE(kQuarter, -kQuarter);
  for (const auto& [left, right, track] :
       {std::array{-0.002, 0.003, 0.0}, std::array{0.0, 0.0, 0.01}, std::array{0.005, -0.004, -0.01}}) {
    const Pose2 end =
        end_of_drive(DriveKind::differential, {.diameter = {left, right}, .track = track}, turn);
    const Pose2 expected = end_of_square({kLeg, turn, kTrack}, {.diameter = {left, right}, .track = track});
    CHECK(end.x == Approx(expected.x).margin(1e-9));
    CHECK(end.y == Approx(expected.y).margin(1e-9));
  }
}

// Type B of the UMBmark: each leg bends by b = L (right - left) / track. To first order the square ends at
// (2 L b, -2 L b) counter-clockwise and at (-2 L b, -2 L b) clockwise.
TEST_CASE("unequal wheels bend both squares to the same side, by the first-order formulas of the UMBmark",
          "[sim][wheels][square]") {
  const double mismatch = 2e-5;
  const double bend = kLeg * mismatch / kTrack;
  const WheelErrors errors{.diameter = {-0.5 * mismatch, 0.5 * mismatch}};
  const Pose2 ccw = end_of_drive(DriveKind::differential, errors, kQuarter);
  const Pose2 cw = end_of_drive(DriveKind::differential, errors, -kQuarter);
  CHECK(ccw.x == Approx(2.0 * kLeg * bend).epsilon(0.005));
  CHECK(ccw.y == Approx(-2.0 * kLeg * bend).epsilon(0.005));
  CHECK(cw.x == Approx(-2.0 * kLeg * bend).epsilon(0.005));
  CHECK(cw.y == Approx(-2.0 * kLeg * bend).epsilon(0.005));
}

// Type A: a track that is larger than assumed makes each turn too small by a = track * 90 deg.
TEST_CASE("another track opens both squares alike, by the first-order formulas of the UMBmark",
          "[sim][wheels][square]") {
  const double track = 2e-4;
  const double short_by = track * kQuarter;
  const Pose2 ccw = end_of_drive(DriveKind::differential, {.track = track}, kQuarter);
  const Pose2 cw = end_of_drive(DriveKind::differential, {.track = track}, -kQuarter);
  CHECK(ccw.x == Approx(-2.0 * kLeg * short_by).epsilon(0.005));
  CHECK(ccw.y == Approx(2.0 * kLeg * short_by).epsilon(0.005));
  CHECK(cw.x == Approx(-2.0 * kLeg * short_by).epsilon(0.005));
  CHECK(cw.y == Approx(-2.0 * kLeg * short_by).epsilon(0.005));
}

TEST_CASE("slip alone scatters the distance in proportion to the root of the way, and of the turn",
          "[sim][wheels]") {
  constexpr int kSlipping = 400;
  const auto deviation = [&](const WheelErrors& errors, const Travel2& way, auto&& off) {
    double squares = 0.0;
    for (int i = 0; i < kSlipping; ++i) {
      Base base(DriveKind::differential, errors, static_cast<std::uint64_t>(i + 1));
      base.roll(way);
      squares += std::pow(off(base.pose()), 2);
    }
    return std::sqrt(squares / kSlipping);
  };
  // 400 samples give the deviation within 11 % (three sigma).
  const double along = deviation({.slip = 0.003}, {kLeg, 0, 0}, [](const Pose2& p) { return p.x - kLeg; });
  CHECK(along == Approx(0.003 * std::sqrt(0.5 * kLeg)).epsilon(0.12));
  const double round =
      deviation({.turn_slip = 0.003}, {0, 0, 2.0}, [](const Pose2& p) { return p.yaw - 2.0; });
  CHECK(round == Approx(0.003 * std::sqrt(2.0 * 2.0) / kTrack).epsilon(0.12));
}

TEST_CASE(
    "a synchro base steers exactly, but unequal wheels turn its body while it rolls, and nothing sees it",
    "[sim][wheels]") {
  const WheelErrors errors{.diameter = {0.004, 0.001, -0.002}};
  Base base(DriveKind::synchro, errors);
  base.roll({0.0, 0.0, kQuarter});
  CHECK(base.pose() == Pose2{0.0, 0.0, base.pose().yaw});
  CHECK(base.pose().yaw == Approx(kQuarter));
  Base straight(DriveKind::synchro, errors);
  straight.roll({kLeg, 0.0, 0.0});
  // Seen from the middle, the wheels at 60 and 300 deg stand 0.75 of the track apart across the way.
  const double turn = kLeg * (-0.002 - 0.004) * std::sin(std::numbers::pi / 3.0) / (0.75 * kTrack);
  CHECK(straight.pose().yaw == Approx(turn));
  CHECK(straight.unseen() < 1e-12);
}

// Wheels at 60, 180 and 300 degrees; one that is e too large adds e (d . v) of the way in direction d, times
// 2/3, and turns by e (d . v) / (3 radius).
TEST_CASE("one wrong wheel of a holonomic base drags it along its own direction", "[sim][wheels]") {
  constexpr double kError = 1e-3;
  WheelModel wheels(drive_of(DriveKind::holonomic), {.diameter = {0.0, kError, 0.0}});
  RandomStream random(1, "dewey", "wheels");
  // The second wheel, at the back, rolls to the right.
  const Travel2 real = wheels.over_ground({0.3, -0.2, 0.0}, 0.0, {}, random);
  const double rolled = 0.2 * kError;
  CHECK(real.forward == Approx(0.3));
  CHECK(real.left == Approx(-0.2 - 2.0 / 3.0 * rolled));
  CHECK(real.turn == Approx(rolled / (1.5 * kTrack)));
}

TEST_CASE("the encoders report what they were told to roll, whatever the wheels are and however they slip",
          "[sim][wheels]") {
  const DriveKind kind = GENERATE(DriveKind::differential, DriveKind::synchro, DriveKind::holonomic);
  Base base(kind, {{0.01, -0.02, 0.015}, 0.03, 0.02, 0.01});
  base.roll({1.0, kind == DriveKind::holonomic ? 0.5 : 0.0, 2.0});
  CHECK(base.unseen() < 1e-12);
}

TEST_CASE("the ratio of the diameters is drawn within the bound, evenly, and apart from the mean",
          "[sim][wheels]") {
  const ErrorLevels nominal = error_levels(Realism::nominal);
  constexpr int kDrawn = 4000;
  double squares = 0.0;
  double products = 0.0;
  for (std::uint64_t seed = 1; seed <= kDrawn; ++seed) {
    RandomStream random(seed, "dewey", "wheels");
    const auto [left, right, none] = WheelErrors::drawn(DriveKind::differential, nominal, random).diameter;
    REQUIRE(std::fabs(right - left) <= nominal.wheel_mismatch);
    squares += std::pow(right - left, 2) / kDrawn;
    products += left * right / kDrawn;
  }
  // An even distribution has the variance of a third of the bound's square.
  CHECK(squares == Approx(std::pow(nominal.wheel_mismatch, 2) / 3.0).epsilon(0.06));
  CHECK(std::fabs(products) < 3.0 * squares / 6.0 / std::sqrt(kDrawn));
}

TEST_CASE("the mean of the diameters is drawn within its bound, whatever their ratio, for bases of each kind",
          "[sim][wheels]") {
  const ErrorLevels recorded = error_levels(Realism::recorded);
  for (const DriveKind kind : {DriveKind::differential, DriveKind::synchro, DriveKind::holonomic}) {
    const double wheels = kind == DriveKind::differential ? 2.0 : 3.0;
    double widest = 0.0;
    for (std::uint64_t seed = 1; seed <= 2000; ++seed) {
      RandomStream random(seed, "dewey", "wheels");
      const auto [one, two, three] = WheelErrors::drawn(kind, recorded, random).diameter;
      widest = std::max(widest, std::fabs(one + two + three) / wheels);
    }
    CHECK(widest <= recorded.wheel_size);
    CHECK(widest > 0.85 * recorded.wheel_size);
  }
}

TEST_CASE("slip in common scatters the way of a base of each kind, and neither turns it nor drags it aside",
          "[sim][wheels]") {
  constexpr int kSlipping = 400;
  const DriveKind kind = GENERATE(DriveKind::differential, DriveKind::synchro, DriveKind::holonomic);
  double squares = 0.0;
  for (std::uint64_t seed = 1; seed <= kSlipping; ++seed) {
    Base base(kind, {.common_slip = 0.01}, seed);
    base.roll({40.0, 0.0, 0.0});
    squares += std::pow(base.pose().x - 40.0, 2) / kSlipping;
    CHECK(std::fabs(base.pose().y) + std::fabs(base.pose().yaw) < 1e-9);
  }
  // Over 40 m the variance is that of 40 m less 1.5 times half the length of 1 m. 400 samples: three sigma.
  CHECK(std::sqrt(squares) == Approx(0.01 * std::sqrt(40.0 - 0.75)).epsilon(0.12));
}

// The paper's claim is that of its summary: the systematic errors become smaller by at least one order of magnitude. Its formulas
// are of first order, so what is left grows with the square of the error. A robot that is off by more than 0.6 m needs a
// second round.
TEST_CASE("the UMBmark makes the errors of robots that do not slip ten times smaller",
          "[sim][wheels][square]") {
  const Realism level = GENERATE(Realism::nominal, Realism::harsh);
  for (std::uint64_t seed = 1; seed <= kDrawnRobots; ++seed) {
    CAPTURE(seed, to_string(level));
    const WheelErrors errors = without_slip(drawn(level, seed));
    const double before = worst_end(errors);
    WheelErrors left = left_after(errors, umbmark(errors, seed));
    if (before > 0.6) left = left_after(left, umbmark(left, seed));
    CHECK(worst_end(left) < 0.1 * before);
  }
}

// Five squares each way say no more than their scatter allows. The ends' mean has a fifth of the variance of one, alpha and
// beta have a weight of 1 / (4 L) for each of two means, E_b is 1 + 2 alpha / pi to first order, and E_d 1 + track beta / L.
TEST_CASE(
    "with slip the UMBmark finds what it finds without, as exactly as the scatter of its squares allows",
    "[sim][wheels][square]") {
  const Realism level = GENERATE(Realism::nominal, Realism::harsh);
  double ratio = 0.0, track = 0.0, scatter = 0.0;
  for (std::uint64_t seed = 1; seed <= kDrawnRobots; ++seed) {
    const WheelErrors errors = drawn(level, seed);
    const Calibration found = umbmark(errors, seed);
    const Calibration expected = umbmark(without_slip(errors), seed);
    ratio += std::pow(found.ratio - expected.ratio, 2) / kDrawnRobots;
    track += std::pow(found.track - expected.track, 2) / kDrawnRobots;
    scatter += found.scatter / kDrawnRobots;
  }
  const double angle = 2.0 * scatter / kRuns / std::pow(4.0 * kLeg, 2);
  // 95 % of chi-square with 200 degrees of freedom, over 200.
  constexpr double kLow = 0.8136;
  constexpr double kHigh = 1.2053;
  INFO(to_string(level) << ": E_d is off by " << std::sqrt(ratio) << ", E_b by " << std::sqrt(track));
  CHECK(ratio / (std::pow(kTrack / kLeg, 2) * angle) > kLow);
  CHECK(ratio / (std::pow(kTrack / kLeg, 2) * angle) < kHigh);
  CHECK(track / (std::pow(2.0 / std::numbers::pi, 2) * angle) > kLow);
  CHECK(track / (std::pow(2.0 / std::numbers::pi, 2) * angle) < kHigh);
}
