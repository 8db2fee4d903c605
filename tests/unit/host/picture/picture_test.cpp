// SPDX-License-Identifier: GPL-3.0-or-later
// The content of pictures, read back pixel by pixel.
#include <cairo.h>

#include <catch2/catch.hpp>
#include <cmath>
#include <fstream>
#include <functional>

#include "orca/host/picture.hpp"
#include "picture/colours.hpp"
#include "picture/key_moments.hpp"
#include "temp_folder.hpp"

using namespace orca;
using namespace orca::host;
using orca::test::TempFolder;
using namespace std::chrono_literals;

namespace {

Scene::Moment moment_at(double seconds, double x) {
  Scene::Moment moment;
  moment.time = TimePoint(std::chrono::milliseconds(static_cast<int>(1000 * seconds)));
  moment.pose = {x, 0.0, 0.0};
  return moment;
}

// A robot that drives along x with 1 m/s for that long.
Scene drive(double seconds) {
  Scene scene;
  scene.walls = {{{-1, -2}, {11, -2}}, {{-1, 2}, {11, 2}}};
  Scene::Robot robot;
  robot.name = "Dewey";
  robot.radius_m = 0.2;
  for (double t = 0.0; t <= seconds; t += 0.1) robot.moments.push_back(moment_at(t, t));
  robot.pose = robot.moments.back().pose;
  scene.robots.push_back(robot);
  return scene;
}

Scene sensing() {
  Scene scene = drive(1.0);
  Scene::Moment& last = scene.robots[0].moments.back();
  last.sonar = {{{0.2, 0.0, 0.5}, 0.2, 1.5, true}};
  last.lasers = {{{0.0, 0.0}, {{1.0, -1.0}, {1.2, -0.8}, {1.4, -0.6}}}};
  last.speed = 1.5;
  last.turn_rate = 1.0;
  return scene;
}

using IsColour = std::function<bool(int red, int green, int blue)>;
const IsColour kYellow = [](int r, int g, int b) { return r > 200 && g > 140 && b < 60; };
const IsColour kBlue = [](int r, int g, int b) { return r < 60 && g < 110 && b > 200; };
const IsColour kDark = [](int r, int g, int b) { return r < 80 && g < 80 && b < 80; };
const IsColour kRed = [](int r, int g, int b) { return r > 180 && g < 60 && b < 60; };

// Not too light for the thin letters of places, too light for walls.
const IsColour kGrey = [](int r, int g, int b) {
  return r > 95 && r < 200 && std::abs(r - g) < 12 && std::abs(g - b) < 12;
};

IsColour is_like(const Colour& colour) {
  return [colour](int r, int g, int b) {
    const auto near = [](double part, int value) { return std::abs(255.0 * part - value) < 6.0; };
    return near(colour.red, r) && near(colour.green, g) && near(colour.blue, b);
  };
}

// Three robots on parallel ways, all within a few metres.
Scene three_in_sight() {
  Scene scene = drive(1.0);
  for (const char* name : {"Huey", "Louie"}) {
    Scene::Robot robot = scene.robots.back();
    robot.name = name;
    for (Scene::Moment& moment : robot.moments) moment.pose.y += 1.0;
    robot.pose = robot.moments.back().pose;
    scene.robots.push_back(robot);
  }
  for (Scene::Robot& robot : scene.robots)
    robot.track = {robot.moments.front().pose.position(), robot.moments.back().pose.position()};
  return scene;
}

Status write(const Scene& scene, const PictureOptions& options) {
  OutputFile file("the picture");
  if (Status opened = file.open(options.file); !opened.ok()) return opened;
  if (Status drawn = write_picture(scene, options, file); !drawn.ok()) return drawn;
  return file.close();
}

/// A picture that was written, read back.
class Pixels {
 public:
  Pixels(const Scene& scene, PictureOptions options) {
    const TempFolder folder;
    options.file = folder.file("picture.png");
    const Status written = write(scene, options);
    INFO((written.ok() ? std::string() : written.error().text()));
    REQUIRE(written.ok());
    surface_ = cairo_image_surface_create_from_png(options.file.c_str());
    REQUIRE(cairo_surface_status(surface_) == CAIRO_STATUS_SUCCESS);
  }
  ~Pixels() { cairo_surface_destroy(surface_); }
  Pixels(const Pixels&) = delete;
  Pixels& operator=(const Pixels&) = delete;

  [[nodiscard]] int width() const { return cairo_image_surface_get_width(surface_); }
  [[nodiscard]] int height() const { return cairo_image_surface_get_height(surface_); }
  /// Returns the number of pixels of that colour in a part of the picture.
  [[nodiscard]] int count(const IsColour& is, int left, int top, int right, int bottom) const {
    const unsigned char* const data = cairo_image_surface_get_data(surface_);
    const int stride = cairo_image_surface_get_stride(surface_);
    int found = 0;
    for (int y = top; y < bottom; ++y)
      for (int x = left; x < right; ++x) {
        const unsigned char* const p = data + y * stride + 4 * x;
        found += is(p[2], p[1], p[0]) ? 1 : 0;
      }
    return found;
  }
  [[nodiscard]] int count(const IsColour& is) const { return count(is, 0, 0, width(), height()); }

 private:
  cairo_surface_t* surface_ = nullptr;
};

std::vector<std::string> reasons(const Scene& scene) {
  std::vector<std::string> why;
  for (const KeyMoment& key : key_moments(scene)) why.push_back(key.why);
  return why;
}

}  // namespace

TEST_CASE("around the robot sonar is yellow, laser blue and motion red, each unless it is hidden",
          "[host][picture]") {
  const Scene scene = sensing();
  for (const View view : {View::world, View::robot, View::film}) {
    CAPTURE(static_cast<int>(view));
    const Pixels all(scene, {"", view, {}});
    CHECK(all.count(kYellow) > 10);
    CHECK(all.count(kBlue) > 10);
    CHECK(all.count(kRed) > 10);
    CHECK(Pixels(scene, {"", view, {Layer::sonar}}).count(kYellow) == 0);
    CHECK(Pixels(scene, {"", view, {Layer::laser}}).count(kBlue) == 0);
    CHECK(Pixels(scene, {"", view, {Layer::motion}}).count(kRed) == 0);
  }
}

TEST_CASE("in the robot's view ahead is up, whatever its heading in the world", "[host][picture]") {
  for (const double heading : {0.0, 1.0, -2.5}) {
    CAPTURE(heading);
    Scene scene = sensing();
    Scene::Moment& last = scene.robots[0].moments.back();
    last.turn_rate = 0.0;
    last.pose.yaw = heading;
    const Pixels view(scene, {"", View::robot, {}});
    const int middle = view.width() / 2;  // the square is as high as wide
    CHECK(view.count(kRed, middle - 5, middle - 155, middle + 5, middle - 20) > 100);
    CHECK(view.count(kRed, 0, middle + 20, view.width(), view.width()) == 0);
    CHECK(view.count(kYellow, 0, 0, middle, middle) > 10);  // the sonar looks to the left
    CHECK(view.count(kYellow, middle + 20, 0, view.width(), view.width()) == 0);
  }
}

TEST_CASE("a robot is its outline with a line from the middle to the front, and nothing beyond",
          "[host][picture]") {
  const Pixels view(sensing(), {"", View::robot, {Layer::walls, Layer::track, Layer::motion, Layer::marks}});
  const int middle = view.width() / 2;
  CHECK(view.count(kDark, middle - 3, middle - 15, middle + 3, middle - 3) >= 12);  // the line
  CHECK(view.count(kDark, middle - 3, middle + 3, middle + 3, middle + 15) == 0);
  CHECK(view.count(kDark, middle - 40, middle - 155, middle + 40, middle - 30) == 0);
}

TEST_CASE("a robot whose outline is not known is a circle round its middle", "[host][picture]") {
  Scene scene = sensing();
  scene.robots[0].radius_m = 1.0;
  const Pixels view(scene,
                    {"",
                     View::robot,
                     {Layer::walls, Layer::track, Layer::motion, Layer::marks, Layer::sonar, Layer::laser}});
  const int middle = view.width() / 2;
  int radius = 0;  // the line to the front ends there
  while (view.count(kDark, middle - 2, middle - radius - 1, middle + 2, middle - radius) > 0) ++radius;
  REQUIRE(radius > 50);
  const auto dark_at = [&](double distance, double angle) {
    const int x = middle - static_cast<int>(distance * std::sin(angle));
    const int y = middle - static_cast<int>(distance * std::cos(angle));
    return view.count(kDark, x - 3, y - 3, x + 3, y + 3) > 0;
  };
  for (double angle = 0.25; angle < 6.2; angle += 0.25) {
    CAPTURE(angle);
    CHECK(dark_at(radius, angle));
    CHECK_FALSE(dark_at(0.8 * radius, angle));
  }
}

TEST_CASE("every view shows all robots, each in a colour of its own", "[host][picture]") {
  const Scene scene = three_in_sight();
  for (const View view : {View::world, View::robot, View::film}) {
    CAPTURE(static_cast<int>(view));
    const Pixels all(scene, {"", view, {}});
    const Pixels nobody(scene, {"", view, {Layer::robot, Layer::track}});
    for (std::size_t number = 0; number < scene.robots.size(); ++number) {
      CAPTURE(number);
      const IsColour own = is_like(robot_colour(number));
      CHECK(all.count(own) > nobody.count(own) + 50);  // without robots only the legend has their colours
      CHECK(nobody.count(own) >= 100);
    }
  }
}

TEST_CASE("a long name of a robot in many bytes a letter is cut so that it can still be drawn",
          "[host][picture]") {
  for (const char* letter : {"o", "\u00e5", "\u20ac", "\U0001f916"}) {
    CAPTURE(letter);
    Scene scene = drive(1.0);
    scene.robots[0].name.clear();
    for (int i = 0; i < 20; ++i) scene.robots[0].name += letter;
    CHECK(Pixels(scene, {"", View::world, {}}).width() == 1200);
  }
}

TEST_CASE("fifty robots have fifty colours", "[host][picture]") {
  for (std::size_t a = 0; a < 50; ++a)
    for (std::size_t b = 0; b < a; ++b) {
      CAPTURE(a, b);
      const Colour one = robot_colour(a);
      const Colour other = robot_colour(b);
      CHECK(std::abs(one.red - other.red) + std::abs(one.green - other.green) +
                std::abs(one.blue - other.blue) >
            0.01);
    }
}

TEST_CASE("a film's key moments of a robot are its own, whoever is near", "[host][picture]") {
  Scene scene = three_in_sight();
  scene.arrivals = {{"park", {1.0, 0.0}, TimePoint(1s), "Huey"}};
  std::vector<std::string> who;
  for (const KeyMoment& key : key_moments(scene))
    if (key.why.find("park") != std::string::npos) who.push_back(key.robot->name);
  CHECK(who == std::vector<std::string>{"Huey"});
}

TEST_CASE("names of places are written unless they are hidden, or an arrival says the same",
          "[host][picture]") {
  const std::set<Layer> bare{Layer::walls, Layer::track, Layer::robot};
  Scene scene = drive(1.0);
  scene.places = {{"kitchen", {5.0, 0.0}}};
  const auto grey_in_the_picture = [&](std::set<Layer> hidden) {
    const Pixels pixels(scene, {"", View::world, std::move(hidden)});
    return pixels.count(kGrey, 0, 0, pixels.width(), pixels.height() - 40);  // above the legend
  };
  CHECK(grey_in_the_picture(bare) > 30);
  std::set<Layer> barer = bare;
  barer.insert(Layer::places);
  CHECK(grey_in_the_picture(barer) == 0);
  scene.arrivals = {{"kitchen", {5.1, 0.0}, TimePoint(1s)}};
  CHECK(grey_in_the_picture(bare) < 10);
}

TEST_CASE("of two names of places that would lie on each other one is written", "[host][picture]") {
  const auto grey = [](const std::vector<Scene::Place>& places) {
    Scene scene = drive(1.0);
    scene.places = places;
    const Pixels pixels(scene, {"", View::world, {Layer::walls, Layer::track, Layer::robot}});
    return pixels.count(kGrey, 0, 0, pixels.width(), pixels.height() - 40);
  };
  const int one = grey({{"kitchen", {5.0, 0.0}}});
  CHECK(grey({{"kitchen", {5.0, 0.0}}, {"kitchen", {5.0, 1.0}}}) > 1.8 * one);
  CHECK(grey({{"kitchen", {5.0, 0.0}}, {"kitchen", {5.3, 0.0}}}) < 1.6 * one);  // and two rings
}

TEST_CASE("the row below the picture explains the colours of what there is, and no others",
          "[host][picture]") {
  const auto in_legend = [](const Scene& scene, const IsColour& colour) {
    const Pixels view(scene, {"", View::robot, {}});
    return view.count(colour, 0, view.width(), view.width(), view.height());  // below the square
  };
  Scene turning = drive(1.0);
  turning.robots[0].moments.back().turn_rate = 1.0;
  Scene driving = drive(1.0);
  driving.robots[0].moments.back().speed = 1.0;
  for (const IsColour& colour : {kYellow, kBlue, kRed}) {
    CHECK(in_legend(sensing(), colour) == 12 * 12);  // a square
    CHECK(in_legend(drive(1.0), colour) == 0);
  }
  CHECK(in_legend(turning, kRed) > 100);
  CHECK(in_legend(driving, kRed) > 100);
}

TEST_CASE("the squares of the row have the middle of the bar beside them", "[host][picture]") {
  const Pixels view(sensing(), {"", View::robot, {}});
  const int middle = view.width() + 26 + 12;  // where the bar is
  CHECK(view.count(kYellow, 0, middle - 6, view.width(), middle + 6) == 12 * 12);
}

TEST_CASE("a bar below the picture shows a round length at its scale", "[host][picture]") {
  const Scene scene = drive(1.0);
  const Pixels view(scene, {"", View::robot, {Layer::walls, Layer::track, Layer::robot, Layer::motion}});
  // 8 m are 800 pixels, so the longest of 1, 2, 5 m that fits into 180 pixels is 1 m, 100 pixels.
  const int top = view.width() + 26 + 11;
  const int dark = view.count(kDark, 200, top, 760, top + 2);
  CHECK(dark >= 190);  // two rows of pixels
  CHECK(dark <= 212);
}

TEST_CASE("a film shows start, arrivals, contacts and end in order, with moments between",
          "[host][picture]") {
  Scene scene = drive(10.0);
  CHECK(reasons(scene) == std::vector<std::string>{"start", "", "", "", "", "end"});
  scene.arrivals = {{"kitchen", {4.0, 0.0}, TimePoint(4s)}};
  scene.contacts = {{"Dewey", {9.0, 0.1}, TimePoint(9s)}, {"Huey", {0.0, 5.0}, TimePoint(9s)}};
  CHECK(reasons(scene) == std::vector<std::string>{"start", "", "at kitchen", "", "contact of Dewey", "end"});
  scene.arrivals.push_back({"hall", {10.0, 0.0}, TimePoint(10s)});
  CHECK(reasons(scene).back() == "at hall, end");
}

TEST_CASE("a film has six moments if nothing happens, and the robot has as many", "[host][picture]") {
  CHECK(reasons(drive(1.0)) == std::vector<std::string>{"start", "", "", "", "", "end"});
}

TEST_CASE("a film of a robot with few moments shows each of them once", "[host][picture]") {
  Scene scene = drive(0.2);
  CHECK(reasons(scene) == std::vector<std::string>{"start", "", "end"});
  scene.robots[0].moments.resize(2);
  CHECK(reasons(scene) == std::vector<std::string>{"start", "end"});
  scene.robots[0].moments.resize(1);
  CHECK(reasons(scene) == std::vector<std::string>{"start"});
}

TEST_CASE("a film of a robot that does much shows twelve moments, first and last among them",
          "[host][picture]") {
  Scene scene = drive(60.0);
  for (int i = 1; i < 40; ++i)
    scene.arrivals.push_back({"p" + std::to_string(i), {1.0 * i, 0.0}, TimePoint(std::chrono::seconds(i))});
  const std::vector<std::string> why = reasons(scene);
  CHECK(why.size() == 12);
  CHECK(why.front() == "start");
  CHECK(why.back() == "end");
  const Pixels film(scene, {"", View::film, {}});
  CHECK(film.width() == 3 * 400);
}

TEST_CASE("a scene without robots or readings is reported, and nothing is written", "[host][picture]") {
  const TempFolder folder;
  Scene scene = drive(1.0);
  scene.robots[0].moments.clear();
  for (const View view : {View::robot, View::film}) {
    const Status status = write(scene, {folder.file("no.png"), view, {}});
    REQUIRE_FALSE(status.ok());
    CHECK(status.error().message.find("no simulated robot has sensed anything") != std::string::npos);
  }
  const Status nothing = write({}, {folder.file("no.png"), View::world, {}});
  REQUIRE_FALSE(nothing.ok());
  CHECK(nothing.error().message.find("no simulated hardware") != std::string::npos);
  CHECK_FALSE(std::ifstream(folder.file("no.png")).good());
}

TEST_CASE("views and layers have the names that people write", "[host][picture]") {
  for (std::size_t i = 0; i < view_names().size(); ++i)
    CHECK(view_from(view_names()[i]) == static_cast<View>(i));
  for (std::size_t i = 0; i < layer_names().size(); ++i)
    CHECK(layer_from(layer_names()[i]) == static_cast<Layer>(i));
  CHECK_FALSE(view_from("World"));
  CHECK_FALSE(layer_from(""));
}
