// SPDX-License-Identifier: GPL-3.0-or-later
// What a simulated camera sees, beside rays that are met with the sides of boxes one by one.
#include <catch2/catch.hpp>

#include <cmath>
#include <optional>
#include <vector>

#include "orca/sim/world.hpp"
#include "scout.hpp"

using namespace orca::sim;
using orca::Colour;
using orca::Vec2;
using namespace orca::sim::test;

namespace {

constexpr double kEye = 0.5;  // [m]

Camera camera(std::size_t width = 64, std::size_t height = 48) {
  Camera camera;
  camera.name = "camera";
  camera.width = width;
  camera.height = height;
  camera.field_of_view = 90.0 * kDegree;
  camera.period = std::chrono::milliseconds{30};
  camera.link_height = kEye;
  return camera;
}

RobotModel scout_with_camera(const Camera& camera) {
  RobotModel model = scout();
  model.cameras = {camera};
  return model;
}

// Returns the first picture that a robot takes.
CameraShot shot_in(const WorldModel& model, const Camera& camera, const orca::Pose2& from = {}) {
  World world(model, {.realism = Realism::ideal});
  const RobotId robot = world.add_robot("Dewey", scout_with_camera(camera), from).value();
  while (!picture_in(world, robot)) world.step();
  return *picture_in(world, robot);
}

std::optional<Colour> pixel(const CameraShot& shot, std::size_t column, std::size_t row) {
  std::size_t run = shot.starts.at(column);
  while (shot.runs.at(run).end <= row) ++run;
  return shot.runs[run].colour;
}

// A box whose sides lie along the axes of the world.
struct Solid {
  Vec2 low, high;
  double bottom, top;
};

WorldModel world_of(const std::vector<Solid>& solids) {
  WorldModel world{"boxes", {}, {}};
  for (const Solid& s : solids) {
    const Vec2 middle = 0.5 * (s.low + s.high);
    world.obstacles.push_back(
        {"box", Box{{middle.x, middle.y, 0.0}, 0.5 * (s.high - s.low)}, s.top, s.bottom});
  }
  return world;
}

// Returns how far along its way a ray meets the sides of a solid [way], and the cosine of the angle there; nothing if it meets none.
struct Met {
  double at;
  double cosine;
};
std::optional<Met> met(const Solid& solid, Vec2 way, double rise) {
  std::optional<Met> first;
  const auto side = [&](double toward, double plane, double across, double low, double high) {
    if (toward == 0.0 || plane / toward <= 0.0) return;
    const double at = plane / toward;
    const double height = kEye + at * rise;
    if (at * across < low || at * across > high || height < solid.bottom || height >= solid.top) return;
    if (!first || at < first->at) first = Met{at, std::fabs(toward) / norm(way)};
  };
  for (const double x : {solid.low.x, solid.high.x}) side(way.x, x, way.y, solid.low.y, solid.high.y);
  for (const double y : {solid.low.y, solid.high.y}) side(way.y, y, way.x, solid.low.x, solid.high.x);
  return first;
}

std::optional<Colour> expected(const std::vector<Solid>& solids, const Camera& camera, std::size_t column,
                               std::size_t row) {
  const double f = 0.5 * static_cast<double>(camera.width) / std::tan(0.5 * camera.field_of_view);
  const Vec2 way{1.0, (0.5 * static_cast<double>(camera.width) - static_cast<double>(column) - 0.5) / f};
  const double rise = (0.5 * static_cast<double>(camera.height) - static_cast<double>(row) - 0.5) / f;
  std::optional<Met> nearest;
  for (const Solid& solid : solids)
    if (const auto here = met(solid, way, rise); here && (!nearest || here->at < nearest->at)) nearest = here;
  if (!nearest) return std::nullopt;
  const double share = 0.6 + 0.4 * nearest->cosine;
  const auto part = [&](std::uint8_t of) { return static_cast<std::uint8_t>(share * of + 0.5); };
  return Colour{part(kPlainColour.red), part(kPlainColour.green), part(kPlainColour.blue)};
}

bool alike(const std::optional<Colour>& a, const std::optional<Colour>& b) {
  if (!a || !b) return a.has_value() == b.has_value();
  return std::abs(a->red - b->red) <= 1 && std::abs(a->green - b->green) <= 1 &&
         std::abs(a->blue - b->blue) <= 1;
}

}  // namespace

TEST_CASE("a camera sees each side of low, high and hanging boxes where a ray meets it", "[sim][camera]") {
  // A low box before a table before a wall; a post of which the camera sees the side; a beam under the ceiling.
  const std::vector<Solid> solids{{{1.0, -0.4}, {1.4, 0.3}, 0.0, 0.3},  {{2.0, -1.0}, {3.0, 0.5}, 0.7, 0.75},
                                  {{4.0, -3.0}, {4.2, 3.0}, 0.0, 2.5},  {{1.5, 0.8}, {1.7, 1.0}, 0.0, 1.2},
                                  {{1.2, -1.2}, {1.3, -0.7}, 0.9, 1.1}, {{2.1, -0.9}, {2.2, -0.8}, 0.0, 0.7}};
  const Camera eye = camera();
  const CameraShot shot = shot_in(world_of(solids), eye);
  int different = 0;
  int sides = 0;
  for (std::size_t row = 0; row < eye.height; ++row)
    for (std::size_t column = 0; column < eye.width; ++column) {
      const auto wanted = expected(solids, eye, column, row);
      sides += wanted.has_value();
      different += !alike(pixel(shot, column, row), wanted);
    }
  CHECK(sides > 1200);
  CHECK(different <= 3);  // Rays that graze an edge.
}

TEST_CASE("each column of a picture is full, and a picture comes once in a period", "[sim][camera]") {
  World world(world_of({{{2.0, -0.5}, {2.1, 0.5}, 0.0, 0.4}}), {.realism = Realism::ideal});
  const RobotId robot = world.add_robot("Dewey", scout_with_camera(camera()), {}).value();
  int pictures = 0;
  for (int tick = 0; tick < 30; ++tick) {
    world.step();
    const auto& shot = picture_in(world, robot);
    if (!shot) continue;
    ++pictures;
    CHECK(shot->stamp == orca::TimePoint{} + pictures * std::chrono::milliseconds{30});
    REQUIRE(shot->starts.size() == camera().width);
    for (std::size_t column = 1; column < shot->starts.size(); ++column)
      CHECK(shot->runs[shot->starts[column] - 1].end == camera().height);
    CHECK(shot->runs.back().end == camera().height);
  }
  CHECK(pictures == 10);
}

TEST_CASE("a person has the colour of his clothes, and people before a camera hide those behind",
          "[sim][camera]") {
  const Colour orange{255, 122, 0};
  WorldModel world = world_of({{{6.0, -3.0}, {6.2, 3.0}, 0.0, 2.5}});
  const auto stander = [](const std::string& name, double x, double y, Colour colour) {
    Walker walker{.name = name, .track = {{x, y}, {x, y + 0.001}}};
    walker.colour = colour;
    return walker;
  };
  world.walkers = {stander("guide", 3.0, 0.0, orange), stander("other", 2.0, 1.0, kClothes)};
  const Camera eye = camera(640, 480);
  const CameraShot shot = shot_in(world, eye);
  const auto in_the_middle = pixel(shot, 320, 240);
  REQUIRE(in_the_middle);
  CHECK(in_the_middle->red > 250);
  CHECK(in_the_middle->blue == 0);
  // 0.25 m of 3 m at 320 pixels: it reaches about 27 columns to either side, and no farther.
  CHECK(pixel(shot, 320 - 26, 240)->blue == 0);
  CHECK(pixel(shot, 320 - 29, 240)->blue > 0);
  // Its foot is at 2.75 m, 0.5 m below the camera.
  CHECK(pixel(shot, 320, 240 + 57)->blue == 0);
  CHECK_FALSE(pixel(shot, 320, 240 + 60));

  world.walkers[1] = stander("other", 1.5, 0.0, kClothes);
  CHECK(pixel(shot_in(world, eye), 320, 240)->blue > 0);
}

TEST_CASE("an outage leaves a robot without pictures", "[sim][camera]") {
  WorldModel world = world_of({{{2.0, -0.5}, {2.1, 0.5}, 0.0, 0.4}});
  world.events.outages = {{.robot = "Dewey", .sensor = SensorKind::camera}};
  World running(world, {.realism = Realism::ideal});
  const RobotId robot = running.add_robot("Dewey", scout_with_camera(camera()), {}).value();
  for (int tick = 0; tick < 20; ++tick) {
    running.step();
    CHECK_FALSE(picture_in(running, robot));
  }
}
