// SPDX-License-Identifier: GPL-3.0-or-later
// The values of the plane, against complex numbers: multiplying by exp(i a) turns by a.
#include <catch2/catch.hpp>

#include <complex>
#include <type_traits>

#include "orca/base/random.hpp"
#include "orca/geometry/arc.hpp"
#include "orca/geometry/objects/plane.hpp"
#include "rounding.hpp"

using namespace orca;
using test::kPi;
using test::kRounding;

namespace {

using Complex = std::complex<double>;

Complex complex_of(Vec2 v) { return {v.x, v.y}; }

bool near(Vec2 a, Vec2 b) { return norm(b - a) < kRounding; }
bool near(const Pose2& a, const Pose2& b) {
  return near(a.position(), b.position()) && std::fabs(wrapped(b.yaw - a.yaw)) < kRounding;
}

Vec2 random_point(RandomStream& random) { return {random.uniform(-9.0, 9.0), random.uniform(-9.0, 9.0)}; }
Pose2 random_pose(RandomStream& random) {
  return {random.uniform(-9.0, 9.0), random.uniform(-9.0, 9.0), random.uniform(-kPi, kPi)};
}

// Returns the final position of a body at a constant twist: the integral of its turning velocity.
Complex integrated(const Twist2& twist, double seconds) {
  const Complex turn(0.0, twist.turn_rate * seconds);
  return Complex(twist.forward, twist.left) * seconds * (std::exp(turn) - 1.0) / turn;
}

}  // namespace

TEST_CASE("values of the plane are copied like numbers", "[geometry][plane]") {
  CHECK(std::is_trivially_copyable_v<Vec2>);
  CHECK(std::is_trivially_copyable_v<Pose2>);
  CHECK(std::is_trivially_copyable_v<Twist2>);
  CHECK(sizeof(Pose2) == 3 * sizeof(double));
}

TEST_CASE("an angle is wrapped into (-pi, pi]", "[geometry][plane]") {
  CHECK(wrapped(0.5) == 0.5);
  CHECK(wrapped(kPi) == kPi);
  CHECK(wrapped(-kPi) == kPi);
  CHECK(wrapped(2.0 * kPi + 0.5) == Approx(0.5).margin(kRounding));
  CHECK(wrapped(-1.5 * kPi) == Approx(0.5 * kPi).margin(kRounding));
  CHECK(std::isnan(wrapped(INFINITY)));
}

TEST_CASE("a wrapped angle is the same direction", "[geometry][plane]") {
  RandomStream random(1, "test", "angles");
  for (int i = 0; i < 10'000; ++i) {
    const double angle = random.uniform(-100.0, 100.0);
    REQUIRE(wrapped(angle) > -kPi);
    REQUIRE(wrapped(angle) <= kPi);
    REQUIRE(std::fabs(std::sin(wrapped(angle) - angle)) < 1e-12);
    REQUIRE(std::cos(wrapped(angle) - angle) > 0.0);
  }
}

TEST_CASE("turning a vector multiplies it by a unit complex number", "[geometry][plane]") {
  RandomStream random(1, "test", "vectors");
  for (int i = 0; i < 1000; ++i) {
    const Vec2 v = random_point(random);
    const double angle = random.uniform(-kPi, kPi);
    REQUIRE(std::abs(complex_of(rotated(v, angle)) - complex_of(v) * std::polar(1.0, angle)) < kRounding);
    REQUIRE(cross(direction(angle), rotated(direction(angle), 0.5 * kPi)) == Approx(1.0));
  }
}

TEST_CASE("plane poses form a group and act on points", "[geometry][plane]") {
  RandomStream random(1, "test", "poses");
  for (int i = 0; i < 1000; ++i) {
    const Pose2 a = random_pose(random);
    const Pose2 b = random_pose(random);
    const Pose2 c = random_pose(random);
    const Vec2 p = random_point(random);
    REQUIRE(near((a * b) * c, a * (b * c)));
    REQUIRE(near(a * inverse(a), Pose2{}));
    REQUIRE(near(inverse(a) * a, Pose2{}));
    REQUIRE(near((a * b) * p, a * (b * p)));
  }
}

TEST_CASE("seen_from is the inverse of applying a pose, for points and for poses", "[geometry][plane]") {
  RandomStream random(1, "test", "seen");
  for (int i = 0; i < 1000; ++i) {
    const Pose2 a = random_pose(random);
    const Pose2 b = random_pose(random);
    const Vec2 p = random_point(random);
    REQUIRE(near(a * seen_from(a, p), p));
    REQUIRE(near(a * seen_from(a, b), b));
  }
}

TEST_CASE("a point ahead comes nearer as the robot drives on", "[geometry][plane]") {
  const Vec2 seen = seen_from({0.3, 0.0, 0.0}, Vec2{1.0, 0.2});
  CHECK(seen.x == Approx(0.7));
  CHECK(seen.y == Approx(0.2));
}

TEST_CASE("a point ahead lies to the right after a quarter turn to the left", "[geometry][plane]") {
  CHECK(near(seen_from({0.0, 0.0, 0.5 * kPi}, Vec2{1.0, 0.0}), {0.0, -1.0}));
}

TEST_CASE("the way between two poses is given in the frame of the first", "[geometry][plane]") {
  const Pose2 way = seen_from({1.0, 1.0, 0.5 * kPi}, Pose2{1.0, 3.0, -kPi + 0.1});
  CHECK(near(way, {2.0, 0.0, 0.5 * kPi + 0.1}));
}

TEST_CASE("a drive at constant velocity is an arc, and backwards in time it leads back",
          "[geometry][plane]") {
  const Twist2 left_turn{.forward = 0.5 * kPi, .turn_rate = 0.5 * kPi};
  CHECK(near(moved(left_turn, 1.0), {1.0, 1.0, 0.5 * kPi}));
  CHECK(near(moved({.forward = 0.5}, -2.0), {-1.0, 0.0, 0.0}));
}

TEST_CASE("a constant twist carries a body along the arc that its velocity integrates to",
          "[geometry][plane]") {
  RandomStream random(1, "test", "arcs");
  for (int i = 0; i < 1000; ++i) {
    const Twist2 twist{random.uniform(-2.0, 2.0), random.uniform(-2.0, 2.0), random.uniform(-3.0, 3.0)};
    const double seconds = random.uniform(-2.0, 2.0);
    const Pose2 start = random_pose(random);
    const Pose2 end = along_arc(start, twist * seconds);
    const Complex way = integrated(twist, seconds) * std::polar(1.0, start.yaw);
    REQUIRE(std::abs(complex_of(end.position() - start.position()) - way) < 1e-12);
    REQUIRE(std::fabs(wrapped(end.yaw - start.yaw - twist.turn_rate * seconds)) < kRounding);
  }
}

TEST_CASE("moving at a twist for a time is the arc from where the body was", "[geometry][plane]") {
  RandomStream random(1, "test", "moved");
  for (int i = 0; i < 1000; ++i) {
    const Twist2 twist{random.uniform(-2.0, 2.0), random.uniform(-2.0, 2.0), random.uniform(-3.0, 3.0)};
    const double seconds = random.uniform(-2.0, 2.0);
    REQUIRE(near(moved(twist, seconds), along_arc({}, twist * seconds)));
  }
  for (const double turn_rate : {1e-3, 1.01e-6, 0.99e-6, 0.0})
    CHECK(near(moved({1.0, 0.5, turn_rate}, 1.0), along_arc({}, {1.0, 0.5, turn_rate})));
}

TEST_CASE("a straight way is the limit of flat arcs", "[geometry][plane]") {
  CHECK(along_arc({1.0, 2.0, 0.5 * kPi}, {.forward = 3.0}).position().y == 5.0);
  for (const double turn : {1e-3, 2.01e-4, 2e-4, 1.99e-4, 1e-9, 0.0})
    CHECK(chord_ratio(turn) == Approx(1.0 - turn * turn / 24.0).epsilon(1e-15));
}

TEST_CASE("the arc between two poses leads from one to the other", "[geometry][plane]") {
  RandomStream random(1, "test", "between");
  for (int i = 0; i < 1000; ++i) {
    const Pose2 from = random_pose(random);
    const Travel2 travel{random.uniform(-2.0, 2.0), random.uniform(-2.0, 2.0), random.uniform(-3.0, 3.0)};
    const Pose2 to = along_arc(from, travel);
    REQUIRE(near(along_arc(from, arc_between(from, to)), to));
    REQUIRE(arc_between(from, to).turn == Approx(travel.turn).margin(kRounding));
  }
}

TEST_CASE("travel over time is the twist again", "[geometry][plane]") {
  const Twist2 twist{0.5, -0.25, 2.0};
  CHECK((twist * 0.5) / 0.5 == twist);
  CHECK(twist * -1.0 == Travel2{-0.5, 0.25, -2.0});
}

TEST_CASE("a twist with any number that is not finite is not finite", "[geometry][plane]") {
  const double nan = std::nan("");
  CHECK(is_finite({0.5, 0.1, -2.0}));
  CHECK_FALSE(is_finite({nan, 0.0, 0.0}));
  CHECK_FALSE(is_finite({0.0, INFINITY, 0.0}));
  CHECK_FALSE(is_finite({0.0, 0.0, nan}));
}

TEST_CASE("a level frame in space and back keeps the pose in the plane", "[geometry][plane]") {
  const Pose2 pose{0.2, -0.1, 1.5};
  const idl::Frame3D frame = level_frame(pose, 0.3);
  CHECK(frame.position().z() == 0.3);
  CHECK(frame.rotation().pitch() == 0.0);
  CHECK(plane_pose(frame) == pose);
}

TEST_CASE("poses that travel as objects are the same in the plane", "[geometry][plane]") {
  idl::Odometry odometry;
  odometry.x(1.0);
  odometry.y(2.0);
  odometry.steer_angle(3.0);
  CHECK(plane_pose(odometry) == Pose2{1.0, 2.0, 3.0});
  idl::RobotPose robot;
  robot.x(4.0);
  robot.y(5.0);
  robot.orientation(-1.0);
  CHECK(plane_pose(robot) == Pose2{4.0, 5.0, -1.0});
}
