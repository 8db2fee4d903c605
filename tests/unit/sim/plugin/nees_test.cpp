// SPDX-License-Identifier: GPL-3.0-or-later
// Whether the shipped robots know how wrong their odometry is: the normalised estimation error squared (NEES) of the pose
// that they publish, e' C^-1 e with e = odometry - truth, averaged over 600 seeds (Y. Bar-Shalom, X. R. Li and T.
// Kirubarajan, "Estimation with Applications to Tracking and Navigation", Wiley 2001, 5.4.2).
#include <Eigen/LU>
#include <catch2/catch.hpp>

#include <array>

#include "objects.hpp"
#include "orca/geometry/angle.hpp"
#include "orca/geometry/objects/plane.hpp"
#include "orca/sim/world.hpp"
#include "shipped.hpp"
#include "sim_sensors.hpp"
#include "slow_run.hpp"

using namespace orca;
using namespace orca::sim;
using namespace orca::sim::test;

namespace {

constexpr int kSeeds = 600;

// Quantiles of chi-square with 1,800 degrees of freedom, over 600: where the mean of 600 values of three degrees of freedom
// each lies with probability 0.999.
struct Band {
  double low;
  double high;
};
constexpr Band kBand{1609.08 / kSeeds, 2004.02 / kSeeds};
// The covariance is linear in the errors of the heading. The Create 2 with its narrow track has turned by more than 10 deg too
// little or too much at harsh, where that is not enough: docs/device-errors.md has what it reaches.
constexpr double kNotLinear = 3.6;

struct Leg {
  std::string what;
  int ticks = 0;
  Twist2 velocity;  // what is asked for; to the left only from a holonomic base
};

// The drive: 2.4 m straight ahead, 206 deg on the spot, and an S of 3.2 m. The NEES is taken after each leg.
const std::array<Leg, 4> kDrive{{{"straight", 600, {0.4, 0.0, 0.0}},
                                 {"turned on the spot", 600, {0.0, 0.0, 0.6}},
                                 {"after a curve to the left", 400, {0.4, 0.0, 0.4}},
                                 {"after a curve to the right", 400, {0.4, 0.0, -0.4}}}};

using MeanNees = std::array<double, kDrive.size()>;

// A robot's odometry as its clients get it, with the guesses of its file times a factor.
class Client {
 public:
  Client(RobotModel model, Realism level, double factor)
      : sensors_(scaled(std::move(model), level, factor), level) {
    for (hw::SensorEndpoint* endpoint : sensors_.endpoints())
      if (endpoint->type().name == "Odometry") odometry_ = endpoint;
  }

  void take(const OdometryReading& reading) {
    SharedWorld::Inbox inbox;
    inbox.odometry.push_back(reading);
    sensors_.publish(inbox);
  }

  [[nodiscard]] double nees(const Pose2& X_OR) const {
    const auto odometry = object_cast<idl::Odometry>(odometry_->latest());
    const Pose2 pose = plane_pose(*odometry);
    const Eigen::Vector3d error(pose.x - X_OR.x, pose.y - X_OR.y, wrapped(pose.yaw - X_OR.yaw));
    const Eigen::Map<const Eigen::Matrix3d> covariance(odometry->covariance().data());
    return error.dot(covariance.inverse() * error);
  }

 private:
  static RobotModel scaled(RobotModel model, Realism level, double factor) {
    WheelErrorGuess guess = model.odometer->errors.at(level);
    guess = {factor * guess.diameter, factor * guess.track, factor * guess.slip, factor * guess.turn_slip};
    model.odometer->errors = {};
    REQUIRE(model.odometer->errors.set(std::nullopt, guess));
    return model;
  }

  SimSensors sensors_;
  const hw::SensorEndpoint* odometry_ = nullptr;
};

// Drives one robot of one seed, and adds its NEES after each leg.
void drive(const RobotModel& model, Realism level, std::uint64_t seed, std::array<Client, 3>& clients,
           std::array<MeanNees, 3>& sums) {
  const Pose2 X_WO{1.0, -2.0, 0.7};
  World world({}, {.seed = seed, .realism = level});
  const RobotId robot = world.add_robot("dewey", model, X_WO).value();
  for (std::size_t leg = 0; leg < kDrive.size(); ++leg) {
    REQUIRE(world.set_velocity_command(robot, kDrive[leg].velocity));
    for (int tick = 0; tick < kDrive[leg].ticks; ++tick) {
      world.step();
      if (const auto& reading = world.odometry(robot))
        for (Client& client : clients) client.take(*reading);
    }
    for (std::size_t k = 0; k < clients.size(); ++k)
      sums[k][leg] += clients[k].nees(inverse(X_WO) * world.pose(robot)) / kSeeds;
  }
}

// Returns the mean NEES with the guesses as they are, halved and doubled.
std::array<MeanNees, 3> mean_nees(const std::string& name, Realism level) {
  RobotModel model = shipped(name);
  model.sonars.clear();
  model.lasers.clear();
  model.infrareds.clear();
  std::array<MeanNees, 3> sums{};
  for (std::uint64_t seed = 1; seed <= kSeeds; ++seed) {
    std::array<Client, 3> clients{Client(model, level, 1.0), Client(model, level, 0.5),
                                  Client(model, level, 2.0)};
    drive(model, level, seed, clients, sums);
  }
  return sums;
}

// Checks all legs, at nominal and at harsh.
void check_nees(const std::string& robot) {
  const Realism level = GENERATE(Realism::nominal, Realism::harsh);
  const auto [shipped_guess, half, twice] = mean_nees(robot, level);
  const double high = robot == "create2" && level == Realism::harsh ? kNotLinear : kBand.high;
  for (std::size_t leg = 0; leg < kDrive.size(); ++leg) {
    INFO(robot << " " << to_string(level) << " " << kDrive[leg].what << ": NEES " << shipped_guess[leg]
               << ", with half the guess " << half[leg] << ", with twice " << twice[leg]);
    CHECK(shipped_guess[leg] > kBand.low);
    CHECK(shipped_guess[leg] < high);
    CHECK(half[leg] > high);
    CHECK(twice[leg] < kBand.low);
  }
}

}  // namespace

TEST_CASE("the odometry of the shipped robots is as uncertain as it says, at nominal and at harsh",
          "[sim][odometry][nees]") {
  // One base of each kind; all in the slow tests.
  const std::string robot = GENERATE(as<std::string>{}, "nomad_scout", "omni", "nomad_200", "pioneer_2dx",
                                     "create2", "nomad_xr4000", "peoplebot", "courier", "barn_base");
  if (robot == "nomad_scout" || robot == "omni" || robot == "nomad_200" || orca::test::is_slow_run())
    check_nees(robot);
}
