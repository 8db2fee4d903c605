// SPDX-License-Identifier: GPL-3.0-or-later
// A Localizer with made-up readings: wrong ones, clocks that jump, maps that come in parts.
#include <catch2/catch.hpp>
#include <cstdlib>
#include <filesystem>
#include <limits>
#include <numbers>

#include "orca/geometry/objects/covariance.hpp"
#include "orca/geometry/objects/plane.hpp"
#include "orca/idl/navigation.hpp"
#include "orca/idl/sensing.hpp"
#include "orca/idl/time.hpp"
#include "orca/testing/component_trial.hpp"
#include "temp_folder.hpp"

using namespace orca;
using namespace orca::testing;
using namespace std::chrono_literals;

namespace {

constexpr double kSide = 0.05;  // [m]
constexpr double kWidth = 6.0;  // [m] of the room
constexpr double kDepth = 4.0;
constexpr double kFarthest = 10.0;

// A room with a corner cut off, so that no two places look alike.
bool is_wall(double x, double y) {
  return x < 0.0 || y < 0.0 || x > kWidth || y > kDepth || (x < 2.0 && y > 3.0);
}

/// A robot in that room, and what it senses.
struct Room final : Partner {
  using Partner::Partner;

  [[nodiscard]] static Loan<idl::OccupancyGrid> map() {
    auto grid = make_object<idl::OccupancyGrid>();
    grid->name("room");
    grid->corner().x(-0.5);
    grid->corner().y(-0.5);
    grid->resolution(kSide);
    grid->columns(140);
    grid->rows(100);
    for (int row = 0; row < 100; ++row)
      for (int column = 0; column < 140; ++column)
        grid->cells().push_back(is_wall(-0.5 + (column + 0.5) * kSide, -0.5 + (row + 0.5) * kSide) ? 100 : 0);
    return grid;
  }

  // One lap of the localizer: an odometry, and between two of them a scan.
  ObjectPtr<idl::RobotPose> step(const Pose2& by = {}) {
    X_WR = X_WR * by;
    X_OR = X_OR * by;
    clock += 0.05;
    if (sees) laser.push(scan());
    clock += 0.05;
    auto reading = odometry.loan();
    reading->x(X_OR.x);
    reading->y(X_OR.y);
    reading->steer_angle(X_OR.yaw);
    reading->stamp(to_time_value(TimePoint(from_seconds(clock))));
    odometry.push(std::move(reading));
    sleep(100ms);
    return pose.latest();
  }
  ObjectPtr<idl::RobotPose> stand(int steps) {
    for (int i = 1; i < steps; ++i) (void)step();
    return step();
  }

  Loan<idl::LaserRangeReadings> scan() {
    auto reading = laser.loan();
    reading->angle_start(-std::numbers::pi / 2.0);
    reading->angle_increment(std::numbers::pi / 180.0);
    reading->max_range(kFarthest);
    reading->min_range(0.02);
    reading->stamp(to_time_value(TimePoint(from_seconds(clock))));
    for (int i = -90; i <= 90; ++i) {
      const Vec2 ahead = direction(X_WR.yaw + i * std::numbers::pi / 180.0);
      double range = 0.0;
      while (!is_wall(X_WR.x + range * ahead.x, X_WR.y + range * ahead.y)) range += 0.005;
      reading->ranges().push_back(spoil ? *spoil : range);
    }
    return reading;
  }

  [[nodiscard]] bool is_known() const { return !is_anywhere(pose.latest()->covariance()); }
  [[nodiscard]] double off() const { return norm(plane_pose(*pose.latest()).position() - X_WR.position()); }

  PushServer<idl::Odometry> odometry{*this, "odometry"};
  PushServer<idl::LaserRangeReadings> laser{*this, "laser"};
  PushServer<idl::OccupancyGrid> maps{*this, "maps"};
  PushProxy<idl::RobotPose> pose{*this, "RobotPosePush"};
  PushProxy<idl::Localization> state{*this, "LocalizationPush"};
  SendProxy<idl::RobotPose> where{*this, "RobotPoseSend"};

  Pose2 X_WR{3.5, 1.5, 2.2};
  Pose2 X_OR{};
  double clock = 100.0;  // [s]
  bool sees = true;
  std::optional<double> spoil;  // range of all beams
};

void in_room(const std::function<void(Room&)>& script) {
  try_component<Room>({.type = "orca.Localizer"}, [&](Room& room) {
    room.maps.push(Room::map());
    script(room);
  });
}

}  // namespace

TEST_CASE("a Localizer does not know where the robot is until it has a map", "[testing][localizer]") {
  try_component<Room>({.type = "orca.Localizer"}, [](Room& room) {
    (void)room.stand(30);
    CHECK_FALSE(room.is_known());
    CHECK(room.state.latest()->state() == idl::LOCALIZATION_UNKNOWN);
    room.maps.push(Room::map());
    (void)room.stand(30);
    CHECK(room.is_known());
    CHECK(room.off() < 0.05);
    CHECK(room.state.latest()->state() == idl::LOCALIZATION_LOCALIZED);
    CHECK(room.state.latest()->places().size() == 1);
    CHECK(room.state.latest()->share() > 0.8);
    CHECK(room.pose.latest()->stamp() == room.state.latest()->stamp());
  });
}

TEST_CASE("a Localizer is lost when its laser says nothing that is true", "[testing][localizer]") {
  for (const double nonsense : {std::numeric_limits<double>::quiet_NaN(), kFarthest, 0.0,
                                std::numeric_limits<double>::infinity(), -1.0}) {
    CAPTURE(nonsense);
    in_room([&](Room& room) {
      (void)room.stand(30);
      REQUIRE(room.is_known());
      room.spoil = nonsense;
      for (int i = 0; i < 60; ++i) (void)room.step({0.05, 0.0, i % 2 == 0 ? 1.5 : -1.5});
      CHECK_FALSE(room.is_known());
      CHECK(room.state.latest()->state() == idl::LOCALIZATION_LOST);
      room.spoil.reset();
      (void)room.stand(30);
      CHECK(room.is_known());
      CHECK(room.off() < 0.05);
    });
  }
}

TEST_CASE("a Localizer whose clock jumps goes on", "[testing][localizer]") {
  in_room([](Room& room) {
    (void)room.stand(30);
    for (const double jump : {3600.0, -7200.0, -0.03}) {
      room.clock += jump;
      (void)room.stand(5);
      CHECK(room.is_known());
      for (int i = 0; i < 10; ++i) (void)room.step({0.05, 0.0, 0.05});
      CHECK(room.is_known());
      CHECK(room.off() < 0.05);
    }
  });
}

TEST_CASE("a Localizer whose odometry begins again doubts its place, and finds the robot",
          "[testing][localizer]") {
  in_room([](Room& room) {
    (void)room.stand(30);
    room.X_OR = {50.0, -20.0, 1.0};
    (void)room.stand(30);
    CHECK(room.is_known());
    CHECK(room.off() < 0.05);
  });
}

TEST_CASE("a Localizer believes who says where the robot is, and notices if it is not there",
          "[testing][localizer]") {
  in_room([](Room& room) {
    (void)room.stand(30);
    const auto say = [&](const Pose2& pose) {
      auto said = room.where.loan();
      said->x(pose.x);
      said->y(pose.y);
      said->orientation(pose.yaw);
      return room.where.send(std::move(said)).ok();
    };
    CHECK(say(room.X_WR * Pose2{0.2, -0.2, 0.1}));
    (void)room.stand(10);
    CHECK(room.is_known());
    CHECK(room.off() < 0.05);
    CHECK(say({1.0, 0.6, -2.0}));
    (void)room.stand(40);
    CHECK((!room.is_known() || room.off() < 0.05));
  });
}

TEST_CASE("a Localizer takes maps and parts of them, and none that says nothing valid",
          "[testing][localizer]") {
  in_room([](Room& room) {
    (void)room.stand(30);
    REQUIRE(room.is_known());
    auto bad = Room::map();
    bad->columns(7);
    room.maps.push(std::move(bad));
    (void)room.stand(10);
    CHECK(room.is_known());
    auto thin = make_object<idl::OccupancyGrid>();
    thin->resolution(kSide);
    thin->columns(50'000);
    thin->rows(1);
    thin->cells().assign(50'000, 0);
    room.maps.push(std::move(thin));
    (void)room.stand(10);
    CHECK(room.is_known());
    // A part in which somebody has drawn a wall across the room: the scan does not fit any more.
    auto part = make_object<idl::OccupancyGrid>();
    part->name("room");
    part->corner().x(2.0);
    part->corner().y(1.0);
    part->resolution(kSide);
    part->columns(60);
    part->rows(60);
    part->cells().assign(3600, 100);
    room.maps.push(std::move(part));
    (void)room.stand(30);
    CHECK_FALSE(room.is_known());
    room.maps.push(Room::map());
    (void)room.stand(30);
    CHECK(room.is_known());
    CHECK(room.off() < 0.05);
  });
}

namespace {

/// A folder in which programs keep what is to be there in the next run.
struct StateHome {
  StateHome() { setenv("XDG_STATE_HOME", folder.path().c_str(), 1); }
  ~StateHome() { unsetenv("XDG_STATE_HOME"); }

  [[nodiscard]] std::string pose() const { return folder.file("orca/kept/room.pose"); }

  test::TempFolder folder;
};

struct Morning {
  Pose2 X_WR{3.5, 1.5, 2.2};
  bool searches = false;  // Then it learns where the robot is by what was kept alone.
  std::size_t changed_cells = 0;
};

// A run of some seconds, of a robot that stands.
void stand(const Morning& morning, const std::function<void(Room&)>& look) {
  try_component<Room>({.type = "orca.Localizer",
                       .params = {{"keeps_pose", "room"}, {"searches", morning.searches ? "true" : "false"}}},
                      [&](Room& room) {
                        auto map = Room::map();
                        for (std::size_t i = 0; i < morning.changed_cells; ++i) map->cells()[i] = 0;
                        room.maps.push(std::move(map));
                        room.X_WR = morning.X_WR;
                        (void)room.stand(30);
                        look(room);
                      });
}

const Pose2 kElsewhere{4.8, 2.8, -2.8};

void check_known(Room& room) {
  CHECK(room.is_known());
  CHECK(room.off() < 0.05);
}
void check_unknown(Room& room) { CHECK_FALSE(room.is_known()); }

}  // namespace

TEST_CASE("a Localizer goes on where the run before has ended, if its scans fit there",
          "[testing][localizer]") {
  const StateHome home;
  stand({}, check_unknown);
  stand({.searches = true}, check_known);
  stand({}, check_known);
  stand({.X_WR = Pose2{3.5, 1.5, 2.2} * Pose2{0.15, -0.15, 0.1}}, check_known);
  SECTION("a robot that was carried off is not there") {
    stand({.X_WR = kElsewhere}, check_unknown);
    stand({.X_WR = kElsewhere, .searches = true}, check_known);
    stand({.X_WR = kElsewhere}, check_known);
  }
  SECTION("a place in another map says nothing") {
    stand({.changed_cells = 1}, check_unknown);
    stand({}, check_known);
  }
  SECTION("what somebody has said comes first") {
    stand({}, [](Room& room) {
      auto said = room.where.loan();
      said->x(kElsewhere.x);
      said->y(kElsewhere.y);
      said->orientation(kElsewhere.yaw);
      REQUIRE(room.where.send(std::move(said)).ok());
      room.X_WR = kElsewhere;
      (void)room.stand(10);
      check_known(room);
    });
    stand({.X_WR = kElsewhere}, check_known);
  }
}

TEST_CASE("a Localizer leaves out a damaged file of where the robot was", "[testing][localizer]") {
  const StateHome home;
  stand({.searches = true}, check_known);
  const std::uintmax_t size = std::filesystem::file_size(home.pose());
  REQUIRE(size > 100);
  std::filesystem::resize_file(home.pose(), GENERATE_COPY(std::uintmax_t{0}, std::uintmax_t{20}, size - 1));
  stand({}, check_unknown);
  stand({.searches = true}, check_known);
  stand({}, check_known);
}
