// SPDX-License-Identifier: GPL-3.0-or-later
#include <catch2/catch.hpp>

#include <Eigen/LU>
#include <numbers>

#include "orca/geometry/arc.hpp"
#include "orca/geometry/objects/odometry.hpp"
#include "poses.hpp"

using namespace orca;
using namespace orca::test;

namespace {

constexpr double kTrack = 0.35;  // [m]
constexpr WheelErrorGuess kGuess{.diameter = 0.003, .track = 0.006, .slip = 0.003, .turn_slip = 0.001};

using Way = std::vector<Travel2>;
using Errors = Vector<4>;  // of three wheels and of the track; a differential base has two wheels

// Returns what three wheels at 60, 180 and 300 deg on that track do per metre forward, metre to the left and turn.
Matrix<3> rolling(double track) {
  Matrix<3> rows;
  for (int k = 0; k < 3; ++k) {
    const double at = (60.0 + 120.0 * k) * std::numbers::pi / 180.0;
    rows.row(k) << -std::sin(at), std::cos(at), 0.5 * track;
  }
  return rows;
}

// Returns the travel that a base reports whose wheels are wrong and slip, from its true travel. It is worked out by
// solving for the travel that explains the wheels best, not by the formulas of the library.
// @param steering [rad]  direction in which the wheels of a synchro base roll, seen from its body.
Travel2 reported(idl::DriveType type, const Travel2& real, const Errors& errors, const Vector<3>& slip,
                 double steering) {
  const double assumed = kTrack * (1.0 + errors(3));
  if (type == idl::DIFFERENTIAL) {
    const double left = (real.forward - 0.5 * kTrack * real.turn) * (1.0 + errors(0)) + slip(0);
    const double right = (real.forward + 0.5 * kTrack * real.turn) * (1.0 + errors(1)) + slip(1);
    return {0.5 * (left + right), 0.0, (right - left) / assumed};
  }
  if (type == idl::HOLONOMIC) {
    const Vector<3> rolled = rolling(kTrack) * Vector<3>(real.forward, real.left, real.turn);
    const Vector<3> seen = rolled.cwiseProduct(Vector<3>::Ones() + errors.head<3>()) + slip;
    const Vector<3> travel = rolling(assumed).inverse() * seen;
    return {travel(0), travel(1), travel(2)};
  }
  // What the three wheels do per metre ahead and per turn of the body, while they point to `steering`.
  Eigen::Matrix<double, 3, 2> abreast;
  const Matrix<3> wheels = rolling(kTrack);
  abreast << Vector<3>::Ones(),
      (wheels.col(0) * std::cos(steering) + wheels.col(1) * std::sin(steering)) * 0.5 * kTrack;
  const Vector<3> ways = real.forward * (Vector<3>::Ones() + errors.head<3>()) + slip;
  const Vector<2> best = (abreast.transpose() * abreast).inverse() * abreast.transpose() * ways;
  return {best(0), 0.0, real.turn + best(1)};
}

// Returns the pose that the odometry reports at the end of the way. @param slip  of each step, in metres.
Pose2 end_of(idl::DriveType type, const Way& way, const Errors& errors, const std::vector<Vector<3>>& slip) {
  Pose2 pose;
  double steering = 0.0;
  for (std::size_t i = 0; i < way.size(); ++i) {
    pose = along_arc(pose, reported(type, way[i], errors, slip[i], steering + 0.5 * way[i].turn));
    steering += way[i].turn;
  }
  return pose;
}

Vector<3> numbers_of(const Pose2& pose) { return {pose.x, pose.y, pose.yaw}; }

Way random_way(RandomStream& random, idl::DriveType type, int steps) {
  Way way;
  for (int i = 0; i < steps; ++i)
    way.push_back({random.uniform(-0.1, 0.2), type == idl::HOLONOMIC ? random.uniform(-0.1, 0.1) : 0.0,
                   random.chance(0.5) ? random.uniform(-0.3, 0.3) : random.normal(0.0, 1e-3)});
  return way;
}

// Returns the wheels' travels in a step, of which their slip depends.
Vector<3> rolled(idl::DriveType type, const Travel2& real) {
  if (type == idl::DIFFERENTIAL)
    return {real.forward - 0.5 * kTrack * real.turn, real.forward + 0.5 * kTrack * real.turn, 0.0};
  if (type == idl::SYNCHRO) return Vector<3>::Constant(real.forward);
  return rolling(kTrack) * Vector<3>(real.forward, real.left, real.turn);
}

// Lets the library follow a way without errors, which is the way as it is reported.
Matrix<3> covariance_after(idl::DriveType type, const Way& way, const WheelErrorGuess& guess) {
  OdometryUncertainty uncertainty(type, kTrack, guess);
  Pose2 pose;
  for (const Travel2& step : way) uncertainty.move_to(pose = along_arc(pose, step));
  const std::array<double, 9> entries = uncertainty.covariance();
  return Eigen::Map<const Matrix<3>>(entries.data());
}

// Returns the covariance by numerical derivatives of the end of the way.
Matrix<3> expected_covariance(idl::DriveType type, const Way& way, const WheelErrorGuess& guess) {
  std::vector<Vector<3>> slip(way.size(), Vector<3>::Zero());
  const auto by_error =
      jacobian<3, 4>([&](const Errors& errors) { return numbers_of(end_of(type, way, errors, slip)); },
                     Errors::Zero().eval());
  const double wheel = guess.diameter * guess.diameter;
  const Errors variance(wheel, wheel, wheel, guess.track * guess.track);
  Matrix<3> sum = by_error * variance.asDiagonal() * by_error.transpose();
  for (std::size_t i = 0; i < way.size(); ++i) {
    const auto by_slip = jacobian<3, 3>(
        [&](const Vector<3>& of_step) {
          std::vector<Vector<3>> one = slip;
          one[i] = of_step;
          return numbers_of(end_of(type, way, Errors::Zero(), one));
        },
        Vector<3>::Zero().eval());
    const Vector<3> spread = guess.slip * guess.slip * rolled(type, way[i]).cwiseAbs() +
                             Vector<3>::Constant(guess.turn_slip * guess.turn_slip * std::abs(way[i].turn));
    sum += by_slip * spread.asDiagonal() * by_slip.transpose();
  }
  return sum;
}

}  // namespace

TEST_CASE("the covariance of the odometry of each kind of base agrees with numerical derivatives",
          "[geometry][odometry]") {
  const idl::DriveType type = GENERATE(idl::DIFFERENTIAL, idl::SYNCHRO, idl::HOLONOMIC);
  RandomStream random(22, "test", "jacobian");
  for (int i = 0; i < 50; ++i) {
    const Way way = random_way(random, type, 20);
    const Matrix<3> difference = covariance_after(type, way, kGuess) - expected_covariance(type, way, kGuess);
    REQUIRE(difference.norm() < 1e-11);  // of about 1e-4
  }
}

// Unequal wheels bend the whole way alike. Slip of one step is not that of the next.
TEST_CASE("errors of wheels add up along a straight way, slip grows with the root of it",
          "[geometry][odometry]") {
  const auto heading = [](double metres, const WheelErrorGuess& guess) {
    const Way way(100, Travel2{metres / 100.0, 0.0, 0.0});
    return std::sqrt(covariance_after(idl::DIFFERENTIAL, way, guess)(2, 2));
  };
  const double root2 = std::sqrt(2.0);
  CHECK(heading(3.0, {.diameter = 0.003}) == Approx(3.0 * 0.003 * root2 / kTrack));
  CHECK(heading(12.0, {.diameter = 0.003}) == Approx(12.0 * 0.003 * root2 / kTrack));
  CHECK(heading(3.0, {.slip = 0.003}) == Approx(std::sqrt(3.0) * 0.003 * root2 / kTrack));
  CHECK(heading(12.0, {.slip = 0.003}) == Approx(std::sqrt(12.0) * 0.003 * root2 / kTrack));
}

TEST_CASE(
    "a wrong track makes every turn of a differential base uncertain in proportion, and turning back undoes "
    "it",
    "[geometry][odometry]") {
  const WheelErrorGuess guess{.track = 0.01};
  Way way(100, Travel2{0.0, 0.0, 0.02});
  CHECK(std::sqrt(covariance_after(idl::DIFFERENTIAL, way, guess)(2, 2)) == Approx(0.02));
  way.resize(200, Travel2{0.0, 0.0, -0.02});
  CHECK(covariance_after(idl::DIFFERENTIAL, way, guess).norm() == Approx(0.0).margin(1e-15));
}

TEST_CASE("the derivatives are continuous where the series take over", "[geometry][odometry]") {
  // The series are used for turns below 0.1 rad.
  const auto covariance_for_turn = [](double turn) {
    return covariance_after(idl::DIFFERENTIAL, {{1.0, 0.0, turn}}, kGuess);
  };
  const double below = std::nextafter(0.1, 0.0) * (1.0 - 1e-12);
  const double above = 0.1 * (1.0 + 1e-12);
  CHECK((covariance_for_turn(below) - covariance_for_turn(above)).norm() < 1e-14);
}

TEST_CASE("without a guess, and at the start, the covariance is not known", "[geometry][odometry]") {
  CHECK(covariance_after(idl::SYNCHRO, Way(10, Travel2{0.1, 0.0, 0.1}), {}).norm() == 0.0);
  CHECK(covariance_after(idl::SYNCHRO, {}, kGuess).norm() == 0.0);
}

TEST_CASE("the covariance of odometry stays a valid one through a hundred thousand random steps",
          "[geometry][odometry]") {
  RandomStream random(23, "test", "steps");
  OdometryUncertainty uncertainty(idl::DIFFERENTIAL, kTrack, kGuess);
  Pose2 pose;
  double least = 0.0;
  for (int i = 0; i < 100'000; ++i) {
    uncertainty.move_to(pose =
                            along_arc(pose, {random.uniform(-0.02, 0.05), 0.0, random.uniform(-0.2, 0.2)}));
    const std::array<double, 9> entries = uncertainty.covariance();
    const Matrix<3> C = Eigen::Map<const Matrix<3>>(entries.data());
    REQUIRE(C == C.transpose());
    least = std::min(least, least_correlation_eigenvalue<3>(C));
  }
  INFO("least eigenvalue of the correlation " << least);
  CHECK(least > -1e-14);
}
