// SPDX-License-Identifier: GPL-3.0-or-later
// What comes from a network may hold any instant, and any name.
#include <catch2/catch.hpp>
#include <cstdint>
#include <limits>
#include <string>

#include "orca/idl/sensing.hpp"
#include "orca/ros/cdr.hpp"
#include "orca/ros/frame_tree.hpp"
#include "orca/ros/range_ring.hpp"
#include "orca/ros/twin.hpp"

using namespace orca;
using namespace orca::ros;

namespace {

constexpr std::int64_t kEarliest = std::numeric_limits<std::int64_t>::min();
constexpr std::int64_t kLatest = std::numeric_limits<std::int64_t>::max();

template <class T>
Loan<T> dated(std::int64_t ns) {
  Loan<T> object = make_object<T>();
  object->stamp().ns(ns);
  return object;
}

const std::string kTooLong(257, 'x');

}  // namespace

TEST_CASE("instants before 1970 have their nanoseconds after the second, down to the earliest one",
          "[ros][twin]") {
  const auto said = [](std::int64_t ns) {
    nav_msgs::Odometry message;
    REQUIRE(from_cdr(ros_twin(dated<idl::Odometry>(ns).seal())->payload, message).ok());
    return message.header.stamp;
  };
  CHECK(said(-1) == builtin_interfaces::Time{-1, 999'999'999});
  CHECK(said(-1'000'000'000) == builtin_interfaces::Time{-1, 0});
  CHECK(said(1'500'000'000) == builtin_interfaces::Time{1, 500'000'000});
  CHECK(said(kEarliest).nanosec == 145'224'192);
}

TEST_CASE("of the odometry of any instants the nearest counts", "[ros][twin]") {
  FrameTree frames;
  for (const auto& [ns, x] : {std::pair{kEarliest, 1.0}, {std::int64_t{0}, 2.0}}) {
    Loan<idl::Odometry> odometry = dated<idl::Odometry>(ns);
    odometry->x(x);
    REQUIRE(frames.hear(std::move(odometry).seal()));
  }
  const auto odometry_at = [&](std::int64_t ns) {
    const auto news = frames.hear(dated<idl::RobotPose>(ns).seal());
    REQUIRE(news);
    return -news->message.transforms.front().transform.translation.x;
  };
  CHECK(odometry_at(kLatest) == 2.0);
  CHECK(odometry_at(kEarliest + 1) == 1.0);
}

TEST_CASE("frames with names of more than 256 characters are nobody's", "[ros][twin]") {
  const auto learns = [](const std::string& parent, const std::string& child) {
    FrameTree frames;
    frames.learn({{{{{}, parent}, child, {{0.1, 0.0, 0.0}, {0.0, 0.0, 0.0, 1.0}}}}});
    return frames.mount_of(child).has_value();
  };
  CHECK(learns("base_link", kTooLong.substr(1)));
  CHECK_FALSE(learns("base_link", kTooLong));
  CHECK_FALSE(learns(kTooLong + "/base_link", "laser"));

  RangeRing ring;
  const auto hear = [&](const std::string& frame) {
    const sensor_msgs::Range message{{{10, 0}, frame}, 0, 0.4F, 0.1F, 3.0F, 1.0F, 0.0F};
    const auto reading =
        twin_from_ros(object_type<idl::SonarRangeReadings>())->from_ros(to_cdr(message), {}, {});
    REQUIRE(reading);
    return object_cast<idl::SonarRangeReadings>(ring.take(*reading))->ranges().size();
  };
  CHECK(hear("sonar") == 1);
  CHECK(hear(kTooLong) == 1);
  CHECK(hear(kTooLong.substr(1)) == 2);
}
