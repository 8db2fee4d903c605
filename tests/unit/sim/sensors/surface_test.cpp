// SPDX-License-Identifier: GPL-3.0-or-later
// How strong the echo of a laser beam is, on surfaces that are plain, black or glass.
#include <catch2/catch.hpp>

#include "laser.hpp"
#include "orca/sim/world_file.hpp"
#include "statistics.hpp"

using namespace orca::sim;
using namespace orca::sim::test;

namespace {

WorldModel wall_of(Finish finish, double distance) {
  WorldModel model = wall_ahead(distance);
  model.obstacles[0].finish = finish;
  return model;
}

// A pane of glass across x = 1, 10 mm thick, and a plain wall across x = 3.
WorldModel glazed() {
  WorldModel model = wall_ahead(3.0);
  model.obstacles.push_back({"pane", Box{{1.005, 0, 0}, {0.005, 20}}, 2.5, 0.0, nullptr, Finish::glass});
  return model;
}

std::vector<double> ranges_of(const WorldModel& model, std::size_t beam, int scans,
                              Realism realism = Realism::nominal) {
  LaserScanner laser = lms200();
  laser.quantum = 0.0;
  World world(model, {.seed = 5, .realism = realism});
  const RobotId id = *world.add_robot("dewey", scout_with(laser), {});
  std::vector<double> ranges;
  for (int i = 0; i < scans; ++i) ranges.push_back(next_scan(world, id).ranges[beam]);
  return ranges;
}

double share_lost(const std::vector<double>& ranges) {
  return static_cast<double>(std::ranges::count(ranges, 8.0)) / static_cast<double>(ranges.size());
}

// 3.29 deviations of a share of 2,000 beams.
double margin(double share) { return 3.29 * std::sqrt(share * (1.0 - share) / 2000.0); }

}  // namespace

TEST_CASE("black surfaces lose beams the more the farther they are, plain ones hardly any",
          "[sim][laser][surface]") {
  for (const double distance : {2.0, 4.0, 6.0}) {
    CAPTURE(distance);
    const double strength = 0.24 * std::pow(8.0 / distance, 2) / 0.64;
    const double expected = std::pow(2.0, -strength);
    CHECK(share_lost(ranges_of(wall_of(Finish::black, distance), 90, 2000)) ==
          Approx(expected).margin(margin(expected)));
    CHECK(share_lost(ranges_of(wall_of(Finish::plain, distance), 90, 2000)) < 0.005);
  }
}

TEST_CASE("a wall loses the more beams the more obliquely they meet it", "[sim][laser][surface]") {
  // 3 m ahead; the beam at 60 deg goes 6 m.
  const double strength = 5.0 * 0.5 * std::pow(8.0 / 6.0, 2) / 0.64;
  const double expected = std::pow(2.0, -strength);
  CHECK(share_lost(ranges_of(wall_of(Finish::plain, 3.0), 150, 2000)) ==
        Approx(expected).margin(margin(expected)));
}

TEST_CASE("the noise of a laser grows as its echo gets weaker", "[sim][laser][surface]") {
  const auto deviation = [](const WorldModel& model) {
    std::vector<double> kept = ranges_of(model, 90, 2000);
    std::erase(kept, 8.0);
    return std::sqrt(variance(kept));
  };
  const auto expected = [](double share, double distance) {
    return 0.005 * std::sqrt(1.0 + 10.0 / (share * std::pow(8.0 / distance, 2) / 0.64));
  };
  CHECK(deviation(wall_of(Finish::plain, 1.0)) == Approx(expected(5.0, 1.0)).epsilon(0.06));
  CHECK(deviation(wall_of(Finish::plain, 7.0)) == Approx(expected(5.0, 7.0)).epsilon(0.06));
  CHECK(deviation(wall_of(Finish::black, 2.0)) == Approx(expected(0.24, 2.0)).epsilon(0.06));
}

TEST_CASE("a laser sees glass head on only, else what is behind it", "[sim][laser][surface]") {
  CHECK(mean(ranges_of(glazed(), 90, 50)) == Approx(1.0).margin(0.015));
  CHECK(mean(ranges_of(glazed(), 93, 50)) == Approx(1.0 / std::cos(3.0 * kDegree)).margin(0.015));
  CHECK(mean(ranges_of(glazed(), 98, 50)) == Approx(3.0 / std::cos(8.0 * kDegree)).margin(0.02));
  CHECK(mean(ranges_of(glazed(), 120, 50)) == Approx(3.0 / std::cos(30.0 * kDegree)).margin(0.02));
}

TEST_CASE("at ideal a laser sees every surface alike", "[sim][laser][surface]") {
  CHECK(ranges_of(glazed(), 120, 1, Realism::ideal)[0] ==
        Approx(1.0 / std::cos(30.0 * kDegree)).margin(1e-9));
  CHECK(share_lost(ranges_of(wall_of(Finish::black, 7.0), 90, 200, Realism::ideal)) == 0.0);
}

TEST_CASE("a world file gives walls, rooms, boxes, cylinders and polygons a surface",
          "[sim][laser][surface][world_file]") {
  orca::xml::Diagnostics errors;
  const auto world = read_world_text(
      "<world name='w' version='1'><wall from='0 0' to='1 0' surface='glass'/>"
      "<room from='2 2' to='8 8' surface='black'/><box x='4' y='4' length='1' width='1' surface='black'/>"
      "<cylinder x='6' y='6' radius='0.2' surface='glass'/><polygon points='0 1; 1 1; 1 1.5' "
      "surface='black'/>"
      "<box x='7' y='7' length='0.1' width='0.1'/></world>",
      "w.xml", errors);
  INFO(errors.text());
  REQUIRE(world);
  std::vector<Finish> finishes;
  for (const Obstacle& o : world->obstacles) finishes.push_back(o.finish);
  CHECK(finishes == std::vector{Finish::glass, Finish::black, Finish::black, Finish::black, Finish::black,
                                Finish::black, Finish::glass, Finish::black, Finish::plain});
}

TEST_CASE("a surface that is not known, and that of what comes and goes, are refused",
          "[sim][surface][world_file]") {
  orca::xml::Diagnostics errors;
  CHECK_FALSE(
      read_world_text("<world name='w' version='1'><wall from='0 0' to='1 0' surface='gold'/>"
                      "<box x='4' y='4' length='1' width='1' comes='2 s' surface='black'/></world>",
                      "w.xml", errors));
  CHECK_THAT(errors.text(), Catch::Contains("\"gold\" is not one of: plain, black, glass"));
  CHECK_THAT(errors.text(), Catch::Contains("what comes and goes is plain"));
}
