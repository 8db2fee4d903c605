// SPDX-License-Identifier: GPL-3.0-or-later
// Drawings stroke by stroke. Whether they are right to look at is for people, who approve them: with ORCA_APPROVE=1 in the environment
// this test writes them to tests/data/drawings, from where rsvg-convert or a browser shows them without their letters.
#include <catch2/catch.hpp>

#include <regex>
#include <string>

#include "approval.hpp"
#include "orca/base/output_file.hpp"
#include "orca/host/picture.hpp"
#include "temp_folder.hpp"

using namespace orca;
using namespace orca::host;
using namespace orca::test;
using namespace std::chrono_literals;

namespace {

Scene::Moment at(double seconds, const Pose2& pose, double speed, double turn_rate) {
  Scene::Moment moment;
  moment.time = TimePoint(std::chrono::milliseconds(static_cast<int>(1000 * seconds)));
  moment.pose = pose;
  moment.speed = speed;
  moment.turn_rate = turn_rate;
  moment.sonar = {{{0.2, 0.1, 0.5}, 0.2, 1.5, true}, {{0.2, -0.1, -0.5}, 0.2, 2.5, false}};
  moment.lasers = {{{0.1, 0.0}, {{1.0, -1.0}, {1.2, -0.8}, {1.4, -0.6}}}};
  return moment;
}

Scene::Robot robot(const std::string& name, double y) {
  Scene::Robot robot;
  robot.name = name;
  robot.radius_m = 0.25;
  for (int i = 0; i <= 6; ++i) robot.moments.push_back(at(0.5 * i, {0.5 * i, y, 0.1 * i}, 1.0, 0.2));
  for (const Scene::Moment& moment : robot.moments) robot.track.push_back(moment.pose.position());
  robot.pose = robot.moments.back().pose;
  return robot;
}

// Everything that a picture can show.
Scene everything() {
  Scene scene;
  scene.walls = {{{-1, -2}, {5, -2}}, {{-1, 2}, {5, 2}}, {{-1, -2}, {-1, 2}}};
  scene.robots = {robot("Dewey", 0.0), robot("Huey", 1.0)};
  scene.robots[1].outline = {
      {{0.3, 0.2}, {-0.3, 0.2}}, {{-0.3, 0.2}, {-0.3, -0.2}}, {{-0.3, -0.2}, {0.3, 0.0}}};
  scene.places = {{"kitchen", {4.0, 1.5}}, {"hall", {4.0, -1.5}}};
  scene.arrivals = {{"park", {1.5, 0.0}, TimePoint(1500ms), "Dewey"}};
  scene.contacts = {{"Huey", {2.0, 1.2}, TimePoint(2s)}};
  return scene;
}

std::string svg_of(const Scene& scene, View view) {
  const TempFolder folder;
  const PictureOptions options{folder.file("drawing.svg"), view, {}};
  OutputFile file("the picture");
  REQUIRE(file.open(options.file).ok());
  REQUIRE(write_picture(scene, options, file).ok());
  REQUIRE(file.close().ok());
  return bytes_of(options.file);
}

// Leaves out what depends on the fonts of this machine, the forms of letters and the places of all but the first of a word, and on
// what the process has drawn before.
std::string without_letters(std::string svg) {
  svg = std::regex_replace(svg, std::regex(R"(<symbol[^]*?</symbol>\n?)"), "");
  svg = std::regex_replace(svg, std::regex(R"(<g id="glyph[^]*?</g>\n?)"), "");
  svg = std::regex_replace(svg, std::regex(R"((<use [^>]*/>\n?)( *<use [^>]*/>\n?)*)"), "$1");
  svg = std::regex_replace(svg, std::regex(R"#( id="surface[0-9]*")#"), "");
  return std::regex_replace(svg, std::regex(R"#(xlink:href="#glyph[-0-9]*")#"), "");
}

}  // namespace

TEST_CASE("drawings are those that were approved, stroke by stroke", "[host][picture]") {
  const auto [view, name] = GENERATE(
      table<View, std::string>({{View::world, "world"}, {View::robot, "robot"}, {View::film, "film"}}));
  CAPTURE(name);
  Scene scene = everything();
  if (view == View::film) scene.robots.resize(1);  // six drawings of each
  check_approved(std::string(ORCA_SOURCE_DIR "/tests/data/drawings/") + name + ".svg",
                 without_letters(svg_of(scene, view)));
}
