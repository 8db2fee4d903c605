// SPDX-License-Identifier: GPL-3.0-or-later
// Where a simulated robot truly ends a square of 4 m that its encoders report exactly: what its wheels do to it in closed
// form, and the scatter of their slip by a Monte Carlo that shares no code with the simulator.
#include "square.hpp"
#include "slow_run.hpp"

#include <Eigen/LU>
#include <catch2/catch.hpp>

#include <array>
#include <random>
#include <utility>
#include <vector>

#include "orca/sim/world.hpp"
#include "scout.hpp"

using namespace orca;
using namespace orca::sim;
using namespace orca::sim::test;
using orca::sim::detail::WheelErrors;

namespace {

constexpr int kSeeds = 200;
constexpr int kLegTicks = 1000;
constexpr int kTurnTicks = 320;
constexpr int kRestTicks = 300;  // until the base stands

RobotModel bare_scout() {
  RobotModel model = scout();
  model.sonars.clear();
  model.odometer = Odometer{World::kTick};
  return model;
}

const Square kSquare{.track = bare_scout().drive.track};

// Drives the square by commands.
class SquareDrive {
 public:
  SquareDrive(Realism level, std::uint64_t seed) : world_({}, {.seed = seed, .realism = level}) {
    robot_ = world_.add_robot("dewey", bare_scout(), {}).value();
    const double tick = to_seconds(World::kTick);
    for (int corner = 0; corner < 4; ++corner) {
      roll({kSquare.leg / (kLegTicks * tick), 0.0, 0.0}, kLegTicks);
      roll({0.0, 0.0, kSquare.turn / (kTurnTicks * tick)}, kTurnTicks);
    }
  }

  [[nodiscard]] Pose2 pose() const { return world_.pose(robot_); }
  [[nodiscard]] Pose2 reported() const { return world_.odometry(robot_).value().pose; }

 private:
  void roll(const Twist2& velocity, int ticks) {
    REQUIRE(world_.set_velocity_command(robot_, velocity));
    for (int i = 0; i < ticks; ++i) world_.step();
    REQUIRE(world_.set_velocity_command(robot_, {}));
    for (int i = 0; i < kRestTicks; ++i) world_.step();
  }

  World world_;
  RobotId robot_{};
};

Eigen::Vector3d apart(const Pose2& a, const Pose2& b) {
  return {a.x - b.x, a.y - b.y, wrapped(a.yaw - b.yaw)};
}

// Noise over a way that is cut into steps: white noise of which each part arrives spread over what follows, with the weight
// s / l^2 exp(-s / l) at a distance s behind it. It is the definition of slip, with l half its length.
class SpreadNoise {
 public:
  SpreadNoise(std::vector<double> steps, double length) : steps_(std::move(steps)) {
    const double l = 0.5 * length;
    steps_.insert(steps_.begin(), kBefore, 8.0 * l / kBefore);
    std::vector<double> middles;
    double way = 0.0;
    for (const double step : steps_) {
      middles.push_back(way + 0.5 * step);
      way += step;
    }
    for (std::size_t i = kBefore; i < steps_.size(); ++i) {
      weights_.emplace_back();
      for (std::size_t j = 0; j < i; ++j) {
        const double s = middles[i] - middles[j];
        if (s < 8.0 * l) weights_.back().emplace_back(j, s / (l * l) * std::exp(-s / l));
      }
    }
  }

  // Returns what arrives in each step.
  template <class Normal>
  std::vector<double> drawn(const Normal& normal) const {
    std::vector<double> white;
    for (const double step : steps_) white.push_back(std::sqrt(step) * normal());
    std::vector<double> sums;
    for (std::size_t i = 0; i < weights_.size(); ++i) {
      double density = 0.0;
      for (const auto& [j, weight] : weights_[i]) density += weight * white[j];
      sums.push_back(density * steps_[kBefore + i]);
    }
    return sums;
  }

 private:
  static constexpr std::size_t kBefore = 50;  // Steps before the first one, whose noise still arrives.

  std::vector<double> steps_;
  std::vector<std::vector<std::pair<std::size_t, double>>> weights_;
};

// Squares of perfect wheels that slip.
class Slipping {
 public:
  explicit Slipping(const ErrorLevels& errors)
      : errors_(errors), by_way_(ways(), errors.slip_length), by_turn_(turns(), errors.slip_angle) {}

  // Returns the covariance of where they end.
  Eigen::Matrix3d covariance() {
    constexpr int kSquares = 4000;
    Eigen::Matrix3d sum = Eigen::Matrix3d::Zero();
    for (int i = 0; i < kSquares; ++i) {
      end_ = Eigen::Vector3d::Zero();
      drive();
      end_[2] -= 4.0 * kSquare.turn;
      sum += end_ * end_.transpose() / kSquares;
    }
    return sum;
  }

 private:
  static constexpr int kLeg = 250, kTurn = 60;  // Steps.
  static double round() { return 0.5 * kSquare.track * kSquare.turn; }

  static std::vector<double> ways() {
    std::vector<double> steps;
    for (int corner = 0; corner < 4; ++corner) {
      steps.insert(steps.end(), kLeg, kSquare.leg / kLeg);
      steps.insert(steps.end(), kTurn, round() / kTurn);
    }
    return steps;
  }
  static std::vector<double> turns() { return std::vector<double>(4 * kTurn, kSquare.turn / kTurn); }

  void drive() {
    const auto normal = [this] { return normal_(random_); };
    const std::array way{by_way_.drawn(normal), by_way_.drawn(normal)};
    const std::array turn{by_turn_.drawn(normal), by_turn_.drawn(normal)};
    std::size_t at = 0, turned = 0;
    for (int corner = 0; corner < 4; ++corner) {
      for (int i = 0; i < kLeg; ++i, ++at) {
        const double step = kSquare.leg / kLeg;
        roll(step + errors_.slip * way[0][at], step + errors_.slip * way[1][at]);
      }
      for (int i = 0; i < kTurn; ++i, ++at, ++turned) {
        const double step = round() / kTurn;
        roll(-step - errors_.slip * way[0][at] + errors_.turn_slip * turn[0][turned],
             step + errors_.slip * way[1][at] + errors_.turn_slip * turn[1][turned]);
      }
    }
  }
  void roll(double left, double right) {
    const double turned = (right - left) / kSquare.track;
    const double middle = end_[2] + 0.5 * turned;
    end_ += Eigen::Vector3d(0.5 * (left + right) * std::cos(middle), 0.5 * (left + right) * std::sin(middle),
                            turned);
  }

  ErrorLevels errors_;
  SpreadNoise by_way_, by_turn_;
  std::mt19937 random_{1};
  std::normal_distribution<double> normal_;
  Eigen::Vector3d end_;
};

// Returns where the base of a seed ends, less what its wheels explain.
Eigen::Vector3d unexplained(Realism level, std::uint64_t seed) {
  const SquareDrive drive(level, seed);
  // The controller drives the square by its encoders, whatever the wheels are.
  CHECK(norm(drive.reported().position()) < 0.002);
  CHECK(std::fabs(wrapped(drive.reported().yaw)) < 0.002);
  RandomStream random(seed, "dewey", "wheels");
  const WheelErrors errors = WheelErrors::drawn(DriveKind::differential, error_levels(level), random);
  return apart(drive.pose(), end_of_square(kSquare, errors));
}

}  // namespace

TEST_CASE("a square of 4 m truly ends where drawn wheels and slip say, over 200 seeds", "[sim][square]") {
  const Realism level =
      orca::test::is_slow_run() ? GENERATE(Realism::nominal, Realism::harsh) : Realism::harsh;
  const Eigen::Matrix3d covariance = Slipping(error_levels(level)).covariance();
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();
  double nees = 0.0;
  for (std::uint64_t seed = 1; seed <= kSeeds; ++seed) {
    const Eigen::Vector3d rest = unexplained(level, seed);
    mean += rest / kSeeds;
    nees += rest.dot(covariance.inverse() * rest) / kSeeds;
  }
  CAPTURE(to_string(level));
  // 95 % of the mean of 200 values of chi-square with three degrees of freedom.
  CHECK(nees > 534.02 / kSeeds);
  CHECK(nees < 669.77 / kSeeds);
  for (int k = 0; k < 3; ++k) CHECK(std::fabs(mean[k]) < 3.0 * std::sqrt(covariance(k, k) / kSeeds));
}

TEST_CASE("at ideal every seed ends its square in the same place, where it began", "[sim][square]") {
  const Pose2 first = SquareDrive(Realism::ideal, 1).pose();
  CHECK(norm(first.position()) < 1e-6);
  CHECK(std::fabs(wrapped(first.yaw)) < 1e-6);
  for (std::uint64_t seed = 2; seed <= orca::test::part_of<std::uint64_t>(kSeeds); ++seed)
    CHECK(SquareDrive(Realism::ideal, seed).pose() == first);
}
