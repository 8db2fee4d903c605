// SPDX-License-Identifier: GPL-3.0-or-later
#include "orca/tracking/mover_tracker.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>
#include <optional>
#include <vector>

#include "orca/geometry/pose2.hpp"

using namespace orca;
using namespace orca::tracking;

namespace {

constexpr double kPeriod = 0.1;  // [s] between scans

struct Post {
  Vec2 place;
  double radius;
};

// Returns how far a beam goes until it meets a post.
std::optional<double> range_to(const Post& post, Vec2 from, Vec2 ahead) {
  const Vec2 off = post.place - from;
  const double along = dot(off, ahead);
  const double aside = off.x * ahead.y - off.y * ahead.x;
  if (along <= 0.0 || std::fabs(aside) >= post.radius) return std::nullopt;
  return along - std::sqrt(post.radius * post.radius - aside * aside);
}

// A scan over the half plane ahead, from the origin, of posts before a wall at x = 5 m.
std::vector<nav::Beam> scan(const std::vector<Post>& posts) {
  std::vector<nav::Beam> beams;
  for (int degrees = -90; degrees <= 90; ++degrees) {
    const Vec2 ahead = direction(degrees * std::numbers::pi / 180);
    double range = ahead.x > 0.0 ? std::min(8.0, 5.0 / ahead.x) : 8.0;
    for (const Post& post : posts) range = std::min(range, range_to(post, {}, ahead).value_or(range));
    beams.push_back({{}, range * ahead, range < 8.0});
  }
  return beams;
}

// Two legs of somebody who walks across.
std::vector<Post> legs(Vec2 middle) {
  return {{middle + Vec2{0.1, 0.1}, 0.06}, {middle - Vec2{0.1, 0.1}, 0.06}};
}

// A tracker that has watched the empty floor for a second.
class Watch {
 public:
  Watch() { see({}, 1.0); }
  // Sees the same for a time [s].
  void see(const std::vector<Post>& posts, double seconds) {
    for (const double end = time_ + seconds - 1e-6; time_ < end; time_ += kPeriod)
      tracker.see(scan(posts), time_);
  }
  // Sees somebody walk for a time [s].  @return where he is then.
  Vec2 walk(Vec2 from, Vec2 velocity, double seconds, const std::vector<Post>& others = {}) {
    for (const double end = time_ + seconds - 1e-6; time_ < end; time_ += kPeriod) {
      std::vector<Post> posts = legs(from);
      posts.insert(posts.end(), others.begin(), others.end());
      tracker.see(scan(posts), time_);
      from = from + kPeriod * velocity;
    }
    return from - kPeriod * velocity;
  }
  MoverTracker tracker;

 private:
  double time_ = 0.0;
};

}  // namespace

TEST_CASE("who walks across is known after half a second, with place and velocity", "[tracking]") {
  Watch watch;
  watch.walk({3.0, -1.0}, {0.0, 1.2}, 0.3);
  CHECK(watch.tracker.movers().empty());
  const Vec2 there = watch.walk({3.0, -0.64}, {0.0, 1.2}, 0.7);
  const auto movers = watch.tracker.movers();
  REQUIRE(movers.size() == 1);
  CHECK(norm(movers[0].place - there) < 0.1);
  CHECK(norm(movers[0].velocity - Vec2{0.0, 1.2}) < 0.2);
  CHECK(movers[0].radius == MoverTracker::kBody);
  CHECK(movers[0].unseen == 0.0);
}

TEST_CASE("what comes and stands is furniture, and what leaves is none that moves", "[tracking]") {
  Watch watch;
  watch.see({{{2.0, 0.5}, 0.3}}, 2.0);
  CHECK(watch.tracker.movers().empty());
  watch.see({}, 2.0);
  CHECK(watch.tracker.movers().empty());
}

TEST_CASE("somebody keeps the number while a column hides him", "[tracking]") {
  Watch watch;
  const std::vector<Post> column{{{1.5, 0.0}, 0.2}};
  watch.see(column, 1.0);
  const Vec2 from = watch.walk({3.0, -1.6}, {0.0, 1.2}, 1.0, column);
  const auto before = watch.tracker.movers();
  REQUIRE(before.size() == 1);
  watch.walk(from, {0.0, 1.2}, 1.6, column);
  const auto after = watch.tracker.movers();
  REQUIRE(after.size() == 1);
  CHECK(after[0].number == before[0].number);
}

TEST_CASE("who has left the field of view goes on as he went, and is forgotten after a while", "[tracking]") {
  Watch watch;
  REQUIRE(watch.walk({1.6, 0.8}, {-1.2, 0.0}, 1.6).x < -0.2);
  const auto last = watch.tracker.movers();
  REQUIRE(last.size() == 1);
  watch.see({}, 1.0);
  const auto gone = watch.tracker.movers();
  REQUIRE(gone.size() == 1);
  CHECK(gone[0].unseen > 0.8);
  CHECK(norm(gone[0].place - (last[0].place + last[0].velocity)) < 0.01);
  watch.see({}, MoverTracker::kUnseen);
  CHECK(watch.tracker.movers().empty());
}

TEST_CASE("two who meet are two, and go on with their numbers", "[tracking]") {
  Watch watch;
  Vec2 one{2.5, -1.5}, two{3.5, 1.5};
  std::vector<std::uint32_t> numbers;
  for (double time = 1.0; time < 3.4; time += kPeriod) {
    std::vector<Post> posts = legs(one);
    for (const Post& leg : legs(two)) posts.push_back(leg);
    watch.see(posts, kPeriod);
    one = one + kPeriod * Vec2{0.0, 1.2};
    two = two + kPeriod * Vec2{0.0, -1.2};
    if (numbers.empty() && watch.tracker.movers().size() == 2)
      for (const Mover& mover : watch.tracker.movers()) numbers.push_back(mover.number);
  }
  const auto movers = watch.tracker.movers();
  REQUIRE(numbers.size() == 2);
  REQUIRE(movers.size() == 2);
  for (const Mover& mover : movers) CHECK(std::ranges::find(numbers, mover.number) != numbers.end());
}

TEST_CASE("after a silence, or a jump back in time, all begins anew", "[tracking]") {
  MoverTracker tracker;
  tracker.see(scan({}), 10.0);
  tracker.see(scan({}), 10.1);
  tracker.see(scan(legs({3.0, 0.0})), 12.0);
  tracker.see(scan(legs({3.0, 0.2})), 5.0);
  CHECK(tracker.movers().empty());
}

TEST_CASE("a scan of nothing is no reason to fail", "[tracking]") {
  MoverTracker tracker;
  tracker.see({}, 1.0);
  tracker.see({}, 1.1);
  CHECK(tracker.movers().empty());
}
