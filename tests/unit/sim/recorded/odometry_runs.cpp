// SPDX-License-Identifier: GPL-3.0-or-later
// Drives a simulated robot as somebody drives through an office, and prints its odometry beside the truth.
//
//     sim_odometry_runs ROBOT.urdf LEVEL SEEDS METRES
//
// Each row of the CSV on stdout is written when the odometry is 1 m or 0.5 rad beyond the row before. Recorded laser
// logs are thinned out in the same way. Exit status 2: wrong arguments.
#include <cmath>
#include <cstdlib>
#include <iostream>
#include <string>
#include <vector>

#include "orca/base/random.hpp"
#include "orca/geometry/angle.hpp"
#include "orca/sim/robot_file.hpp"
#include "orca/sim/world.hpp"

namespace {

using namespace orca::sim;
using orca::Pose2;

constexpr double kRowDistance = 1.0;  // [m]
constexpr double kRowTurn = 0.5;      // [rad]
constexpr double kSpeed = 0.5;        // [m/s]
constexpr double kTurnRate = 0.8;     // [rad/s]

void print(const Pose2& pose) { std::cout << ',' << pose.x << ',' << pose.y << ',' << pose.yaw; }

// One robot on an empty plane, and the rows that it has printed.
class Drive {
 public:
  Drive(const RobotModel& model, Realism realism, std::uint64_t seed)
      : seed_(seed), world_({"plane", {}, {}}, {.seed = seed, .realism = realism}) {
    robot_ = world_.add_robot("robot", model, {}).value();
  }

  // Holds a command for some time [s].
  void go(double forward, double turn_rate, double seconds) {
    if (!world_.set_velocity_command(robot_, forward, turn_rate)) std::abort();
    const auto end = world_.time() + orca::Duration(std::llround(seconds * 1e9));
    while (world_.time() < end) {
      world_.step();
      if (const auto& reading = world_.odometry(robot_)) look_at(reading->pose);
    }
  }

 private:
  void look_at(const Pose2& odometry) {
    const double moved = norm(odometry.position() - last_.position());
    const double turned = std::abs(orca::wrapped(odometry.yaw - last_.yaw));
    if (moved < kRowDistance && turned < kRowTurn) return;
    last_ = odometry;
    std::cout << seed_;
    print(odometry);
    print(world_.pose(robot_));
    std::cout << '\n';
  }

  std::uint64_t seed_;
  World world_;
  RobotId robot_{};
  Pose2 last_{};
};

void run(const RobotModel& model, Realism realism, std::uint64_t seed, double metres) {
  Drive drive(model, realism, seed);
  orca::RandomStream legs(seed, "odometry_runs", "legs");
  for (double driven = 0.0; driven < metres;) {
    const double length = legs.uniform(1.0, 6.0);
    drive.go(kSpeed, 0.0, length / kSpeed);
    const double turn = legs.uniform(0.3, 3.0);
    drive.go(0.0, legs.chance(0.5) ? kTurnRate : -kTurnRate, turn / kTurnRate);
    driven += length;
  }
}

// A robot that measures nothing but its way drives faster.
RobotModel without_sensors(RobotModel model) {
  model.sonars.clear();
  model.lasers.clear();
  model.infrareds.clear();
  model.bumpers.clear();
  return model;
}

}  // namespace

int main(int argc, char** argv) {
  const std::vector<std::string> arguments(argv + 1, argv + argc);
  const auto realism = arguments.size() == 4 ? realism_from(arguments[1]) : std::nullopt;
  orca::xml::Diagnostics errors;
  const auto model = realism ? read_robot(arguments[0], errors) : std::nullopt;
  if (!model) {
    std::cerr << errors.text() << "sim_odometry_runs ROBOT.urdf LEVEL SEEDS METRES\n";
    return 2;
  }
  std::cout.precision(12);
  std::cout << "seed,odometry_x,odometry_y,odometry_yaw,true_x,true_y,true_yaw\n";
  for (std::uint64_t seed = 1; seed <= std::stoul(arguments[2]); ++seed)
    run(without_sensors(*model), *realism, seed, std::stod(arguments[3]));
  return 0;
}
