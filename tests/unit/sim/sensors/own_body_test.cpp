// SPDX-License-Identifier: GPL-3.0-or-later
// A laser that sees parts of its own robot, where the robot's file says so.
#include <catch2/catch.hpp>

#include <cmath>
#include <fstream>
#include <sstream>

#include "laser.hpp"
#include "orca/sim/robot_file.hpp"

using namespace orca::sim;
using namespace orca::sim::test;
using Catch::Contains;

namespace {

const std::string kDeck = std::string(ORCA_SOURCE_DIR) + "/sim/fixtures/pioneer_2dx_deck.urdf";
const orca::Vec2 kOfLaser{0.017, 0.008};

// The text of the robot with another one in place of what its laser says of the posts.
std::string deck_that(const std::string& said) {
  std::ostringstream text;
  text << std::ifstream(kDeck).rdbuf();
  std::string robot = text.str();
  const std::size_t at = robot.find("sees=\"");
  const std::string end = "-54 deg\"";
  robot.replace(at, robot.find(end) + end.size() - at, said);
  return robot;
}

RobotModel read_deck(const std::string& text) {
  orca::xml::Diagnostics errors;
  const auto robot = read_robot_text(text, "r.urdf", errors);
  INFO(errors.text());
  REQUIRE(robot.has_value());
  return *robot;
}

std::string errors_of_deck(const std::string& said) {
  orca::xml::Diagnostics errors;
  CHECK_FALSE(read_robot_text(deck_that(said), "r.urdf", errors).has_value());
  return errors.text();
}

LaserScan scan_of_deck(const RobotModel& robot, Realism realism = Realism::ideal) {
  World world(wall_ahead(2.0), {.seed = 1, .realism = realism});
  return next_scan(world, *world.add_robot("dewey", robot, {}));
}

// The exact range to a post at (0.1, y), or to the wall, whatever is nearer.
double exact_range(double angle) {
  double range = std::cos(angle) > 0.0 ? (2.0 - kOfLaser.x) / std::cos(angle) : 8.0;
  const orca::Vec2 ahead{std::cos(angle), std::sin(angle)};
  for (const double y : {0.15, -0.15}) {
    const orca::Vec2 post = orca::Vec2{0.1, y} - kOfLaser;
    const double beside = cross(ahead, post);
    if (std::fabs(beside) < 0.02 && dot(ahead, post) > 0.0)
      range = std::min(range, dot(ahead, post) - std::sqrt(0.02 * 0.02 - beside * beside));
  }
  return std::min(range, 8.0);
}

}  // namespace

TEST_CASE(
    "a laser meets the links of its own robot that the file names, at their exact distance, and no others",
    "[sim][laser][own]") {
  const RobotModel deck = read_deck(deck_that("sees='left_post right_post'"));
  const LaserScan scan = scan_of_deck(deck);
  const LaserScan blind = scan_of_deck(read_deck(deck_that("")));
  std::size_t own = 0;
  for (std::size_t k = 1; k + 1 < scan.ranges.size(); ++k) {  // the outermost graze the wall at infinity
    const double exact = exact_range(angle_of(deck.lasers[0], k));
    CHECK(scan.ranges[k] == Approx(exact).margin(1e-6));
    own += exact < 0.2 ? 1 : 0;
    CHECK(blind.ranges[k] > 1.0);
  }
  CHECK(own > 20);
}

TEST_CASE("every beam that meets a post of the shipped robot lies in a direction that its file ignores",
          "[sim][laser][own]") {
  orca::xml::Diagnostics errors;
  const auto deck = read_robot(kDeck, errors);
  REQUIRE(deck.has_value());
  for (const Realism realism : {Realism::ideal, Realism::nominal, Realism::harsh}) {
    const LaserScan scan = scan_of_deck(*deck, realism);
    std::size_t ignored = 0;
    for (std::size_t k = 0; k < scan.ranges.size(); ++k) {
      const bool ignores = deck->lasers[0].ignores(angle_of(deck->lasers[0], k));
      ignored += ignores ? 1 : 0;
      INFO("beam " << k);
      if (!ignores) CHECK(scan.ranges[k] > 1.0);
    }
    CHECK(ignored == 19 + 17);
  }
}

TEST_CASE("links that a laser cannot see, and what is no sector, are errors that say why",
          "[sim][laser][own]") {
  CHECK_THAT(errors_of_deck("sees='mast'"), Contains("R012") && Contains("there is no link \"mast\""));
  CHECK_THAT(errors_of_deck("sees='plate'"),
             Contains("R022") && Contains("at the height of the laser, 0.3 m"));
  for (const std::string sector : {"50 deg", "50 deg, 40 deg", "a, b", "1, 2, 3", ""})
    CHECK_THAT(errors_of_deck("ignore='" + sector + "'"), Contains("R005") && Contains("is not a sector"));
}
