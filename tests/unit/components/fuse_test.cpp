// SPDX-License-Identifier: GPL-3.0-or-later
// The three ways in which several wishes blend into one command: weighted, vector sum, vote.
#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <vector>

#include "motion_command_fuser/fusion.hpp"
#include "orca/base/random.hpp"

using namespace orca::fuse;
using Catch::Detail::Approx;
using std::numbers::pi;

namespace {

constexpr double kGain = 1.5;
constexpr Ballot kBallot{
    .steer_gain = kGain, .max_turn_rate = 1.0, .rate_spread = 0.15, .speed_spread = 0.1, .inertia = 0.2};

Wish heading(double direction, double speed, double weight) {
  return {Wish::Kind::direction, direction, speed, weight};
}
Wish turning(double rate, double speed, double weight) {
  return {Wish::Kind::turn_rate, rate, speed, weight};
}

std::vector<Wish> random_wishes(orca::RandomStream& random, double widest) {
  std::vector<Wish> wishes(1 + random() % 6);
  for (Wish& wish : wishes)
    wish = heading(random.uniform(-widest, widest), random.uniform(-1.0, 1.0), random.uniform(0.1, 5.0));
  return wishes;
}

struct Blend {
  const char* name;
  Fused (*fuse)(std::span<const Wish>);
};

const Blend kWeighted{"weighted", [](std::span<const Wish> w) { return fuse_weighted(w, kGain); }};
const Blend kVectorSum{"vector sum", [](std::span<const Wish> w) { return sum_vectors(w, kGain); }};
const Blend kVote{"vote", [](std::span<const Wish> w) { return vote(w, kBallot, 0.0); }};

double slowest(const std::vector<Wish>& wishes) {
  return std::ranges::min_element(wishes, {}, &Wish::speed)->speed;
}
double fastest(const std::vector<Wish>& wishes) {
  return std::ranges::max_element(wishes, {}, &Wish::speed)->speed;
}

// Returns the turn rate that a base makes of a command.
double rate_of(const Wish& command) {
  return command.kind == Wish::Kind::turn_rate ? command.value : kGain * command.value;
}

}  // namespace

TEST_CASE("in every mode one wish is fused to itself", "[components][fuser]") {
  const Blend blend = GENERATE(kWeighted, kVectorSum, kVote);
  CAPTURE(blend.name);
  for (const double direction : {-0.5, -0.013, 0.0, 0.3, 0.6}) {
    const Fused fused = blend.fuse(std::vector{heading(direction, 0.5, 3.0)});
    CHECK(rate_of(fused.command) == Approx(kGain * direction).margin(1e-6));
    CHECK(fused.command.speed == Approx(0.5));
    CHECK(fused.command.weight == 3.0);
    CHECK(fused.shares == std::vector{1.0});
  }
  CHECK(rate_of(blend.fuse(std::vector{turning(0.4, 0.1, 0.5)}).command) == Approx(0.4));
}

TEST_CASE("in every mode each wish has a share, and the shares add up to one", "[components][fuser]") {
  const Blend blend = GENERATE(kWeighted, kVectorSum, kVote);
  CAPTURE(blend.name);
  orca::RandomStream random(1, "test", "shares");
  for (int i = 0; i < 200; ++i) {
    const std::vector<Wish> wishes = random_wishes(random, 1.5);
    const Fused fused = blend.fuse(wishes);
    REQUIRE(fused.shares.size() == wishes.size());
    CHECK(std::accumulate(fused.shares.begin(), fused.shares.end(), 0.0) == Approx(1.0));
    for (const double share : fused.shares) CHECK(share >= 0.0);
  }
}

TEST_CASE("in every mode the fused speed lies within the speeds wished for", "[components][fuser]") {
  const Blend blend = GENERATE(kWeighted, kVectorSum, kVote);
  CAPTURE(blend.name);
  orca::RandomStream random(2, "test", "speed");
  for (int i = 0; i < 500; ++i) {
    const std::vector<Wish> wishes = random_wishes(random, pi);
    const Fused fused = blend.fuse(wishes);
    CHECK(fused.command.speed >= std::min(0.0, slowest(wishes)) - 1e-12);
    CHECK(fused.command.speed <= std::max(0.0, fastest(wishes)) + 1e-12);
  }
}

TEST_CASE("in every mode the order of the wishes does not matter", "[components][fuser]") {
  const Blend blend = GENERATE(kWeighted, kVectorSum, kVote);
  CAPTURE(blend.name);
  orca::RandomStream random(3, "test", "order");
  for (int i = 0; i < 200; ++i) {
    std::vector<Wish> wishes = random_wishes(random, 0.6);
    const Wish before = blend.fuse(wishes).command;
    std::ranges::rotate(wishes, wishes.begin() + static_cast<long>(random() % wishes.size()));
    std::ranges::reverse(wishes);
    const Wish after = blend.fuse(wishes).command;
    CHECK(after.value == Approx(before.value).margin(1e-9));
    CHECK(after.speed == Approx(before.speed).margin(1e-9));
  }
}

TEST_CASE("in every mode scaling all weights changes nothing but the weight", "[components][fuser]") {
  const Blend blend = GENERATE(kWeighted, kVectorSum, kVote);
  CAPTURE(blend.name);
  orca::RandomStream random(4, "test", "scale");
  for (int i = 0; i < 200; ++i) {
    std::vector<Wish> wishes = random_wishes(random, 0.6);
    const Wish before = blend.fuse(wishes).command;
    for (Wish& wish : wishes) wish.weight *= 8.0;
    const Wish after = blend.fuse(wishes).command;
    CHECK(after.value == Approx(before.value).margin(1e-9));
    CHECK(after.speed == Approx(before.speed).margin(1e-9));
    CHECK(after.weight == Approx(8.0 * before.weight));
  }
}

TEST_CASE("in every mode the mirrored wishes give the mirrored command, unless they are symmetric",
          "[components][fuser]") {
  const Blend blend = GENERATE(kWeighted, kVectorSum, kVote);
  CAPTURE(blend.name);
  orca::RandomStream random(5, "test", "mirror");
  for (int i = 0; i < 200; ++i) {
    std::vector<Wish> wishes = random_wishes(random, 0.6);
    const Wish before = blend.fuse(wishes).command;
    for (Wish& wish : wishes) wish.value = -wish.value;
    const Wish after = blend.fuse(wishes).command;
    CHECK(after.value == Approx(-before.value).margin(1e-9));
    CHECK(after.speed == Approx(before.speed).margin(1e-9));
  }
}

TEST_CASE("a vote between left and right passes a symmetric obstacle, and the mean drives into it",
          "[components][fuser]") {
  for (const double aside : {0.3, 0.5, 0.9, 1.5}) {
    const std::vector wishes{heading(aside, 0.2, 1.0), heading(-aside, 0.2, 1.0)};
    CAPTURE(aside);
    CHECK(std::abs(fuse_weighted(wishes, kGain).command.value) < 1e-12);
    CHECK(std::abs(sum_vectors(wishes, kGain).command.value) < 1e-12);
    CHECK(std::abs(vote(wishes, kBallot, 0.0).command.value) > 0.2);
  }
}

TEST_CASE("a vote passes a symmetric obstacle also beside a lighter wish to drive straight on",
          "[components][fuser]") {
  const std::vector wishes{heading(0.6, 0.2, 1.0), heading(-0.6, 0.2, 1.0), heading(0.0, 0.5, 0.4)};
  CHECK(std::abs(fuse_weighted(wishes, kGain).command.value) < 1e-12);
  const Fused voted = vote(wishes, kBallot, 0.0);
  CHECK(std::abs(voted.command.value) == Approx(kGain * 0.6).margin(0.01));
  CHECK(voted.command.speed == Approx(0.2));
}

TEST_CASE("a tied vote goes to the side to which the robot turns already, else to the left",
          "[components][fuser]") {
  const std::vector wishes{heading(0.5, 0.2, 1.0), heading(-0.5, 0.2, 1.0)};
  CHECK(vote(wishes, kBallot, 0.0).command.value > 0.5);
  CHECK(vote(wishes, kBallot, -0.7).command.value < -0.5);
  CHECK(vote(wishes, kBallot, 0.7).command.value > 0.5);
}

TEST_CASE("a side once voted for is kept until the other has clearly more votes", "[components][fuser]") {
  const auto turn = [](double left, double right) {
    return vote(std::vector{heading(0.5, 0.2, left), heading(-0.5, 0.2, right)}, kBallot, 0.75).command.value;
  };
  CHECK(turn(1.0, 1.4) > 0.5);   // 0.42 + 0.2 against 0.58
  CHECK(turn(1.0, 1.6) < -0.5);  // 0.38 + 0.2 against 0.62
}

TEST_CASE("a vote stays within the fastest turn that is voted on", "[components][fuser]") {
  orca::RandomStream random(6, "test", "turns");
  for (int i = 0; i < 500; ++i) {
    const Fused fused = vote(random_wishes(random, pi), kBallot, random.uniform(-1.0, 1.0));
    CHECK(std::abs(fused.command.value) <= kBallot.max_turn_rate + 1e-12);
  }
}

TEST_CASE("a vote of similar wishes gives a turn between them, and of two distant wishes the heavier wins",
          "[components][fuser]") {
  const Fused alike = vote(std::vector{turning(0.30, 0.2, 1.0), turning(0.36, 0.2, 1.0)}, kBallot, 0.0);
  CHECK(alike.command.value > 0.30);
  CHECK(alike.command.value < 0.36);
  const Fused apart = vote(std::vector{turning(0.8, 0.1, 1.0), turning(-0.8, 0.4, 1.2)}, kBallot, 0.0);
  CHECK(apart.command.value == Approx(-0.8).margin(1e-3));
  CHECK(apart.command.speed == Approx(0.4).margin(1e-3));
  CHECK(apart.shares[1] > 0.99);
}

TEST_CASE("the heavier wish pulls the weighted direction to its side", "[components][fuser]") {
  const std::vector even{heading(0.5, 1.0, 1.0), heading(-0.5, 0.0, 1.0)};
  CHECK(fuse_weighted(even, kGain).command.value == Approx(0.0).margin(1e-12));
  CHECK(fuse_weighted(even, kGain).command.speed == Approx(0.5));
  const std::vector left{heading(0.5, 1.0, 3.0), heading(-0.5, 0.0, 1.0)};
  CHECK(fuse_weighted(left, kGain).command.value > 0.2);
  CHECK(fuse_weighted(left, kGain).command.speed == Approx(0.75));
}

TEST_CASE("directions across the rear are fused over the rear, not over the front", "[components][fuser]") {
  const Blend blend = GENERATE(kWeighted, kVectorSum);
  const Fused fused = blend.fuse(std::vector{heading(pi - 0.1, 0.5, 1.0), heading(-pi + 0.1, 0.5, 1.0)});
  CHECK(std::abs(fused.command.value) == Approx(pi));
}

TEST_CASE("the weighted direction lies within the cone of the wishes", "[components][fuser]") {
  const Blend blend = GENERATE(kWeighted, kVectorSum);
  orca::RandomStream random(7, "test", "cone");
  for (int i = 0; i < 500; ++i) {
    const std::vector<Wish> wishes = random_wishes(random, 1.5);
    const auto [right, left] = std::ranges::minmax_element(wishes, {}, &Wish::value);
    const Fused fused = blend.fuse(wishes);
    CHECK(fused.command.value >= right->value - 1e-12);
    CHECK(fused.command.value <= left->value + 1e-12);
  }
}

TEST_CASE("next to a turn rate, a direction counts as a turn rate of the gain times the direction",
          "[components][fuser]") {
  const Fused fused = fuse_weighted(std::vector{heading(0.4, 0.2, 1.0), turning(-0.2, 0.4, 3.0)}, kGain);
  CHECK(fused.command.kind == Wish::Kind::turn_rate);
  CHECK(fused.command.value == Approx((kGain * 0.4 - 3.0 * 0.2) / 4.0));
  CHECK(fused.command.speed == Approx((0.2 + 3.0 * 0.4) / 4.0));
  CHECK(fused.command.weight == 4.0);
}

TEST_CASE("the robot stands if opposite directions of equal weight cancel out", "[components][fuser]") {
  const Blend blend = GENERATE(kWeighted, kVectorSum);
  for (const double direction : {0.3, 1.0, pi / 2, 2.5}) {
    const Fused fused =
        blend.fuse(std::vector{heading(direction, 0.5, 1.0), heading(direction - pi, 0.5, 1.0)});
    CHECK(fused.command.value == 0.0);
    CHECK(fused.command.speed == 0.0);
  }
}

TEST_CASE("the sum of vectors is slower the less they agree, and the weighted mean keeps its speed",
          "[components][fuser]") {
  double last = 0.5;
  for (double apart = 0.1; apart < 3.0; apart += 0.1) {
    const std::vector wishes{heading(apart / 2, 0.5, 1.0), heading(-apart / 2, 0.5, 1.0)};
    const double speed = sum_vectors(wishes, kGain).command.speed;
    CHECK(speed < last);
    CHECK(speed == Approx(0.5 * std::cos(apart / 2)));
    CHECK(fuse_weighted(wishes, kGain).command.speed == Approx(0.5));
    last = speed;
  }
}
