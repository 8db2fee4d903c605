// SPDX-License-Identifier: GPL-3.0-or-later
#include <catch2/catch.hpp>

#include <cmath>
#include <cstddef>
#include <numbers>
#include <string>
#include <vector>

#include "orca/hw/p2os/model.hpp"

using namespace orca::hw;
using p2os::choose_model;
using p2os::Model;

namespace {

constexpr double kDegree = std::numbers::pi / 180.0;

// A row of the table of models, in its units.
struct Row {
  const char* subclass;
  double distance_mm, range_mm, difference;
  double width_mm, length_mm, radius_mm, speed_mm, turn_deg;
  std::size_t sonars;
  int front_bumpers, rear_bumpers;
};

constexpr double kPioneer1 = 1.0 / 300.0;

const std::vector<Row> kRows = {
    {"p2dx", 0.84, 0.268, 0.0056, 425, 511, 250, 2200, 500, 16, 0, 0},
    {"p2ce", 0.826, 0.268, 0.0057, 425, 511, 250, 2200, 500, 16, 0, 0},
    {"p2de", 0.969, 0.268, 0.0056, 425, 511, 250, 2200, 500, 16, 0, 0},
    {"p2df", 0.485, 0.268, 0.0060, 425, 511, 250, 2200, 500, 16, 0, 0},
    {"p2d8", 0.485, 1.0, 0.0056, 425, 511, 250, 2200, 500, 16, 0, 0},
    {"p2d8+", 0.485, 1.0, 0.0056, 425, 511, 250, 2200, 500, 16, 0, 0},
    {"p2at", 1.32, 0.268, 0.0034, 505, 626, 500, 1200, 300, 16, 0, 0},
    {"p2at8", 1.32, 1.0, 0.0034, 505, 626, 500, 1200, 300, 16, 0, 0},
    {"p2at8+", 0.465, 1.0, 0.0034, 505, 626, 500, 1200, 300, 16, 0, 0},
    {"p2it", 1.136, 0.268, 0.0032, 505, 626, 500, 1200, 300, 16, 0, 0},
    {"p2pb", 0.424, 0.268, 0.0056, 425, 513, 300, 2200, 500, 24, 5, 5},
    {"p2pp", 0.485, 0.268, 0.0060, 425, 513, 300, 2200, 500, 24, 5, 5},
    {"perfpb", 0.485, 1.0, 0.0060, 425, 513, 340, 2200, 500, 32, 5, 5},
    {"perfpb+", 0.485, 1.0, 0.0060, 425, 511, 340, 2200, 500, 32, 5, 5},
    {"peoplebot-sh", 1.0, 1.0, 0.0060, 425, 513, 340, 2200, 500, 32, 5, 5},
    {"peoplebot-sh-lms1xx", 1.0, 1.0, 0.0060, 425, 513, 340, 2200, 500, 32, 5, 5},
    {"peoplebot-sh-lms500", 1.0, 1.0, 0.0060, 425, 513, 340, 2200, 500, 32, 5, 5},
    {"p3dx", 0.485, 1.0, 0.0056, 425, 511, 250, 2200, 500, 16, 0, 0},
    {"p3dx-sh", 1.0, 1.0, 0.0056, 425, 511, 250, 2200, 500, 16, 0, 0},
    {"p3dx-sh-lms1xx", 1.0, 1.0, 0.0056, 425, 511, 250, 2200, 500, 16, 0, 0},
    {"p3dx-sh-lms500", 1.0, 1.0, 0.0056, 425, 511, 250, 2200, 500, 16, 0, 0},
    {"p3at", 0.465, 1.0, 0.0034, 505, 626, 500, 1200, 300, 16, 0, 0},
    {"p3at-sh", 1.0, 1.0, 0.0034, 505, 626, 500, 1200, 300, 16, 0, 0},
    {"p3at-sh-lms1xx", 1.0, 1.0, 0.0034, 505, 626, 500, 1200, 300, 16, 0, 0},
    {"p3at-sh-lms500", 1.0, 1.0, 0.0034, 505, 626, 500, 1200, 300, 16, 0, 0},
    {"p3atiw-sh", 1.0, 1.0, 0.0034, 490, 626, 500, 1200, 300, 16, 0, 0},
    {"amigo", 0.5083, 1.0, 0.011, 279, 330, 180, 1000, 300, 8, 0, 0},
    {"amigo-sh", 1.0, 1.0, 0.011, 279, 330, 180, 1000, 300, 8, 0, 0},
    {"amigo-sh-tim3xx", 1.0, 1.0, 0.011, 279, 330, 180, 1000, 300, 8, 0, 0},
    {"patrolbot-sh", 1.0, 1.0, 0.0056, 425, 510, 250, 2200, 500, 16, 6, 6},
    {"mt400", 1.0, 1.0, 0.0056, 425, 510, 250, 2200, 500, 16, 6, 6},
    {"researchPB", 1.0, 1.0, 0.0056, 425, 510, 250, 2200, 500, 16, 6, 6},
    {"researchPB-lms500", 1.0, 1.0, 0.0056, 425, 510, 250, 2200, 500, 16, 6, 6},
    {"powerbot", 0.5813, 1.0, 0.00373, 680, 911, 550, 2000, 360, 32, 7, 5},
    {"powerbot-sh", 1.0, 1.0, 0.00373, 680, 911, 550, 2000, 360, 32, 7, 5},
    {"powerbot-sh-lms500", 1.0, 1.0, 0.00373, 680, 911, 550, 2000, 360, 32, 7, 5},
    {"powerbot-sh-uarcs", 1.0, 1.0, 0.00373, 680, 911, 550, 2000, 360, 16, 7, 5},
    {"wheelchair-sh", 1.0, 1.0, 0.00373, 680, 1340, 550, 2000, 360, 0, 4, 3},
    {"seekur", 1.0, 1.0, 0.0056, 1270, 1410, 833, 2200, 190, 0, 5, 3},
    {"seekurjr", 1.0, 1.0, 0.0056, 830, 1200, 600, 1200, 80, 0, 4, 4},
    {"pioneer-lx", 1.0, 1.0, 0.0056, 500, 696, 348, 2500, 180, 0, 3, 3},
    {"pioneer-lx-ld", 1.0, 1.0, 0.0056, 500, 696, 348, 2500, 180, 0, 3, 3},
    {"mappr", 1.0, 1.0, 0.011, 0, 0, 180, 0, 0, 0, 0, 0},
    {"pion1m", 0.05066, 0.1734, kPioneer1, 0, 0, 220, 400, 100, 7, 0, 0},
    {"pion1x", 0.05066, 0.1734, kPioneer1, 0, 0, 220, 400, 100, 7, 0, 0},
    {"psos1m", 0.05066, 0.1734, kPioneer1, 0, 0, 220, 400, 100, 7, 0, 0},
    {"psos1x", 0.05066, 0.1734, kPioneer1, 0, 0, 220, 400, 100, 7, 0, 0},
    {"psos43m", 0.05066, 0.1734, kPioneer1, 0, 0, 220, 400, 100, 7, 0, 0},
    {"pionat", 0.07, 0.1734, kPioneer1, 0, 0, 330, 500, 100, 7, 0, 0},
};

void check_pose(const orca::Pose2& pose, double x_mm, double y_mm, double heading_deg) {
  CHECK(pose.x == Approx(x_mm / 1000));
  CHECK(pose.y == Approx(y_mm / 1000));
  CHECK(pose.yaw == Approx(heading_deg * kDegree));
}

}  // namespace

TEST_CASE("the axle of a Pioneer 2-DX is in front of the middle of its body", "[hw][p2os]") {
  CHECK(choose_model("p2dx").model.behind == Approx(0.0445));
  CHECK(choose_model("p2at").model.behind == 0.0);  // it has two
}

TEST_CASE("every model has the figures of its parameter file in SI units", "[hw][p2os]") {
  CHECK(p2os::models().size() == kRows.size());
  for (const Row& row : kRows) {
    INFO(row.subclass);
    const auto [model, is_known] = choose_model(row.subclass);
    CHECK(is_known);
    CHECK(model.subclass == row.subclass);
    CHECK(model.distance_unit == Approx(row.distance_mm / 1000));
    CHECK(model.range_unit == Approx(row.range_mm / 1000));
    CHECK(model.half_track == Approx(0.001 / row.difference));
    CHECK(model.width == Approx(row.width_mm / 1000));
    CHECK(model.length == Approx(row.length_mm / 1000));
    CHECK(model.radius == Approx(row.radius_mm / 1000));
    CHECK(model.max_speed == Approx(row.speed_mm / 1000));
    CHECK(model.max_turn_rate == Approx(row.turn_deg * kDegree));
    CHECK(model.sonar_poses.size() == row.sonars);
    CHECK(model.front_bumpers == row.front_bumpers);
    CHECK(model.rear_bumpers == row.rear_bumpers);
    const bool is_first = row.difference == kPioneer1;  // of the series Pioneer 1
    CHECK(model.angle_unit == Approx(is_first ? 0.0061359 : 0.001534).epsilon(1e-4));
    if (is_first) CHECK(model.velocity_unit == Approx(0.0025332));
  }
}

TEST_CASE("speeds of an AmigoBot and a MapperBot have a unit of their own", "[hw][p2os]") {
  for (const Model& model : p2os::models()) {
    INFO(model.subclass);
    const bool is_own = model.subclass == "amigo" || model.subclass == "mappr";
    if (!model.subclass.starts_with("p")) CHECK(model.velocity_unit == Approx(is_own ? 0.0006154 : 0.001));
  }
}

TEST_CASE("upper and lower case count alike in the name of a model", "[hw][p2os]") {
  CHECK(choose_model("P2DX").model.subclass == "p2dx");
  CHECK(choose_model("PeopleBot-SH").model.subclass == "peoplebot-sh");
  CHECK(choose_model("p2d8").model.subclass == "p2d8");
}

TEST_CASE("an unknown model gives the default and says so", "[hw][p2os]") {
  for (const std::string subclass : {"", "p2d", "p2dxx", "p4xx"}) {
    INFO(subclass);
    CHECK_FALSE(choose_model(subclass).is_known);
    CHECK(choose_model(subclass).model.subclass == "p2dx");
  }
}

TEST_CASE("the ring of a Pioneer 2-DX looks ahead with its first half and back with its second",
          "[hw][p2os]") {
  const auto ring = choose_model("p2dx").model.sonar_poses;
  REQUIRE(ring.size() == 16);
  check_pose(ring[0], 69, 136, 90);
  check_pose(ring[3], 166, 27, 10);
  check_pose(ring[4], 166, -27, -10);
  check_pose(ring[7], 69, -136, -90);
  check_pose(ring[8], -157, -136, -90);
  check_pose(ring[12], -255, 27, 170);
  check_pose(ring[15], -157, 136, 90);
}

TEST_CASE("a PeopleBot has a second ring above the front one, between it and the rear one", "[hw][p2os]") {
  const auto ring = choose_model("p2pb").model.sonar_poses;
  REQUIRE(ring.size() == 24);
  check_pose(ring[7], 69, -136, -90);
  check_pose(ring[8], -20, 136, 90);
  check_pose(ring[12], 77, -27, -10);
  check_pose(ring[15], -20, -136, -90);
  check_pose(ring[16], -157, -136, -90);
  check_pose(ring[23], -157, 136, 90);
}

TEST_CASE("a PeopleBot with the SH controller counts its rear ring before the upper ones", "[hw][p2os]") {
  const auto ring = choose_model("peoplebot-sh").model.sonar_poses;
  REQUIRE(ring.size() == 32);
  check_pose(ring[8], -157, -136, -90);
  check_pose(ring[16], -20, 136, 90);
  check_pose(ring[31], -191, 136, 90);
}

TEST_CASE("a PowerBot counts an eighth sonar on each quarter that is not there", "[hw][p2os]") {
  const Model& model = choose_model("powerbot-sh").model;
  CHECK(model.absent_sonars == 0x80808080U);
  check_pose(model.sonar_poses[6], 332, 33, 5);
  check_pose(model.sonar_poses[8], 332, -33, -5);
  CHECK(choose_model("powerbot-sh-uarcs").model.absent_sonars == 0x8080U);
  CHECK(choose_model("p3at").model.absent_sonars == 0U);
}

TEST_CASE("a Performance PeopleBot has an upper rear ring too", "[hw][p2os]") {
  const auto ring = choose_model("perfpb").model.sonar_poses;
  REQUIRE(ring.size() == 32);
  check_pose(ring[24], -191, -136, -90);
  check_pose(ring[27], -290, -27, -170);
  check_pose(ring[31], -191, 136, 90);
}

TEST_CASE("the rings of round robots are symmetric, each sonar looking away from the middle", "[hw][p2os]") {
  for (const char* subclass : {"p2dx", "p2pb", "perfpb"}) {
    const auto ring = choose_model(subclass).model.sonar_poses;
    for (std::size_t half = 0; half < ring.size(); half += 8) {
      for (std::size_t i = 0; i < 8; ++i) {
        const auto& right = ring[half + i];
        const auto& left = ring[half + 7 - i];
        CHECK(right.x == left.x);
        CHECK(right.y == -left.y);
        CHECK(right.yaw == -left.yaw);
        CHECK(right.y * std::sin(right.yaw) > 0.0);
      }
    }
  }
}
