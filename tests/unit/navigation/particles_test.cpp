// SPDX-License-Identifier: GPL-3.0-or-later
#include "orca/navigation/particles.hpp"

#include <array>
#include <catch2/catch.hpp>
#include <cmath>
#include <span>

#include "grids.hpp"
#include "orca/navigation/sonar_model.hpp"

using namespace orca;
using namespace orca::nav;

namespace {

const PoseSpread kSomewhere{{2.0, -1.0, 3.1}, {0.04, 0.01, 0.0, 0.01, 0.09, 0.0, 0.0, 0.0, 0.01}};

void check_alike(const PoseSpread& a, const PoseSpread& b, double share) {
  CHECK(a.mean.x == Approx(b.mean.x).margin(share * 0.3));
  CHECK(a.mean.y == Approx(b.mean.y).margin(share * 0.3));
  CHECK(wrapped(a.mean.yaw - b.mean.yaw) == Approx(0.0).margin(share * 0.1));
  for (std::size_t i = 0; i < 9; ++i) CHECK(a.covariance[i] == Approx(b.covariance[i]).margin(share * 0.09));
}

double count_of(const Particles& particles) { return static_cast<double>(particles.all().size()); }

}  // namespace

TEST_CASE("particles lie as they were scattered, also where directions jump", "[navigation]") {
  RandomStream random(1, "test", "particles");
  Particles particles;
  particles.scatter(kSomewhere, 20000, random);
  check_alike(particles.spread(), kSomewhere, 0.05);
}

TEST_CASE("particles move as a pose and its errors do", "[navigation]") {
  RandomStream random(1, "test", "particles");
  Particles particles;
  particles.scatter(kSomewhere, 20000, random);
  const Pose2 step{0.5, 0.0, 0.3};
  const std::array<double, 3> deviations{0.1, 0.05, 0.04};
  particles.move(step, deviations, random);
  check_alike(particles.spread(), after(kSomewhere, step, deviations), 0.05);
}

TEST_CASE("particles take the mean and covariance that a measurement leaves", "[navigation]") {
  RandomStream random(1, "test", "particles");
  Particles particles;
  particles.scatter(kSomewhere, 200, random);
  const PoseSpread seen{{2.2, -1.1, -3.1}, {0.01, 0.0, 0.0, 0.0, 4.0, 0.0, 0.0, 0.0, 0.02}};
  const PoseSpread both = fused(particles.spread(), seen);
  particles.shape(both, random);
  check_alike(particles.spread(), both, 1e-6);
  // Known better than by either, and nearer to the one that knows it.
  CHECK(both.covariance[0] < 0.01);
  CHECK(both.mean.x > 2.1);
  CHECK(std::fabs(both.mean.y + 1.0) < 0.05);
  CHECK(squared_distance(both, both.mean) == 0.0);
  CHECK(squared_distance({{}, {4.0, 0, 0, 0, 1.0, 0, 0, 0, 1.0}}, {2.0, 0.0, 0.0}) == Approx(1.0));
}

TEST_CASE("particles are drawn as often as their weights say", "[navigation]") {
  RandomStream random(1, "test", "particles");
  Particles particles;
  std::vector<Pose2> poses;
  for (int i = 0; i < 1000; ++i) poses.push_back({i < 500 ? 0.0 : 5.0, 0.0, 0.0});
  particles.put(poses);
  const auto likelihood = [](const Pose2& pose) { return pose.x < 1.0 ? 0.95 : 0.05; };
  CHECK(particles.weigh(likelihood) == Approx(0.5));
  particles.weigh([](const Pose2& pose) { return pose.x < 1.0 ? 1.0 : 0.5; });
  particles.resample(random);
  CHECK(particles.spread().mean.x == Approx(5.0 * 0.025 / 0.975).margin(0.06));
}

TEST_CASE("there are as many particles as the places that they may be in need", "[navigation]") {
  RandomStream random(1, "test", "particles");
  const auto kept = [&](double deviation) {
    Particles particles;
    particles.scatter(
        {{0.1, 0.1, 0.08}, {deviation * deviation, 0, 0, 0, deviation * deviation, 0, 0, 0, 1e-4}}, 4000,
        random);
    // Half of them count for nothing, so that they are drawn anew.
    particles.weigh([](const Pose2& pose) { return pose.x > 0.1 ? 1.0 : 1e-6; });
    particles.weigh([](const Pose2& pose) { return pose.y > 0.1 ? 1.0 : 1e-6; });
    particles.resample(random);
    return count_of(particles);
  };
  CHECK(kept(0.01) == 100.0);
  CHECK(kept(1.0) > 1000.0);
  CHECK(kept(100.0) == 5000.0);
}

TEST_CASE("particles of nearly equal weights are left alone", "[navigation]") {
  RandomStream random(1, "test", "particles");
  Particles particles;
  particles.scatter(kSomewhere, 300, random);
  particles.weigh([](const Pose2& pose) { return pose.x > 2.0 ? 1.0 : 0.8; });
  particles.resample(random);
  CHECK(count_of(particles) == 300.0);
}

TEST_CASE("weights stay if a measurement is possible nowhere, or is no number", "[navigation]") {
  RandomStream random(1, "test", "particles");
  Particles particles;
  particles.scatter(kSomewhere, 300, random);
  for (const double likelihood : {0.0, std::nan(""), HUGE_VAL}) {
    particles.weigh([&](const Pose2& pose) { return pose.x > 2.0 ? likelihood : 0.0; });
    for (const Particles::Particle& particle : particles.all())
      REQUIRE(particle.weight == Approx(1.0 / 300.0));
  }
}

TEST_CASE("a matrix that is no covariance still scatters particles", "[navigation]") {
  RandomStream random(1, "test", "particles");
  Particles particles;
  // Correlated by more than 1, and a variance below 0.
  particles.scatter({{2.0, -1.0, 0.5}, {0.04, 0.09, 0.0, 0.09, 0.04, 0.0, 0.0, 0.0, -0.01}}, 2000, random);
  const PoseSpread spread = particles.spread();
  CHECK(spread.mean.x == Approx(2.0).margin(0.02));
  CHECK(spread.covariance[0] == Approx(0.04).epsilon(0.1));
  CHECK(spread.covariance[4] == Approx(0.04).epsilon(0.1));
  CHECK(spread.covariance[8] < 1e-9);
}

TEST_CASE("a sonar's range that is no number says nothing", "[navigation]") {
  const KnownMap map(test::two_rooms_grid());
  const Pose2 here{3.0, 2.0, 0.0};
  const std::array echoes{SonarEcho{{}, 2.0, 5.0, 0.2}, SonarEcho{{0.0, 0.0, 1.5}, std::nan(""), 5.0, 0.2}};
  CHECK(likelihood(echoes, map, here) == likelihood(std::span(echoes).first(1), map, here));
  CHECK(share_heard(echoes, map, here) == share_heard(std::span(echoes).first(1), map, here));
}

TEST_CASE("particles that are all alike, or on a line, take a covariance too", "[navigation]") {
  RandomStream random(1, "test", "particles");
  std::vector<Pose2> alike(2000, Pose2{1.0, 1.0, 0.5});
  std::vector<Pose2> line;
  for (int i = 0; i < 2000; ++i) line.push_back({0.001 * i, 0.001 * i, 0.5});
  for (const std::vector<Pose2>& poses : {alike, line}) {
    Particles particles;
    particles.put(poses);
    particles.shape(kSomewhere, random);
    check_alike(particles.spread(), kSomewhere, 0.1);
    CHECK(count_of(particles) == 2000.0);
  }
}

TEST_CASE("a step of odometry is as wrong as its covariance has grown, within bounds", "[navigation]") {
  const Reckoned before{0.0, {10.0, 5.0, 0.0}, {0.04, 0, 0, 0, 0.04, 0, 0, 0, 0.01}};
  Reckoned now{1.0, {10.0, 5.0, 0.0}, before.covariance};
  CHECK(deviations_of(before, now)[0] == Approx(0.002));
  now.X_OR = {11.0, 5.0, 0.0};
  CHECK(deviations_of(before, now)[0] == Approx(0.022));  // the covariance does not even grow: the floor
  now.covariance = {0.04 + 0.01, 0, 0, 0, 0.04 + 0.01 + 0.01, 0, 0, 0, 0.01 + 0.0036};
  CHECK(deviations_of(before, now)[0] ==
        Approx(0.1));  // the error of the direction has moved it by as much, too
  CHECK(deviations_of(before, now)[2] == Approx(0.06));
  now.covariance = {400.0, 0, 0, 0, 400.0, 0, 0, 0, 4.0};
  CHECK(deviations_of(before, now)[0] == Approx(0.222));
}
