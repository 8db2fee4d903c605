// SPDX-License-Identifier: GPL-3.0-or-later
// Random sonar poses among legs, posts, boards, corners, cells, kerbs and table tops, against a cone of 2,001 rays.
#include <catch2/catch.hpp>

#include <iomanip>
#include <sstream>

#include "cone_of_rays.hpp"
#include "furnished_room.hpp"
#include "orca/base/random.hpp"
#include "sensors/sonar_beam.hpp"
#include "slow_run.hpp"

using namespace orca::sim;
using namespace orca::sim::test;
using orca::Pose2;
using orca::RandomStream;

namespace {

constexpr double kHalfLobe = 12.5 * kDegree;
constexpr double kMaxRange = 6.5;
constexpr double kHeight = 0.3;

struct Tally {
  int poses = 0, heard = 0, missed = 0, wrong = 0;
  std::ostringstream text;  // What went wrong.
};

// Compares one pose at one critical angle.
void compare(const Caster& caster, const Pose2& pose, std::vector<UprightFace> faces, double critical,
             detail::Echo& echo, Tally& tally) {
  const detail::Beam beam(pose, detail::Lobe(kHalfLobe), 0.15, kMaxRange, kHeight,
                          static_cast<std::size_t>(-1));
  detail::listen_for(caster, beam, std::tan(critical), echo);
  ConeOfRays cone(std::move(faces), kHalfLobe, kMaxRange, critical);
  const std::optional<double> exact = cone.nearest();
  ++tally.poses;
  tally.heard += exact ? 1 : 0;
  // Where nothing answers, a second bounce may be heard. It comes from farther away than the mirror.
  const bool right = exact ? echo.range && std::fabs(*echo.range - *exact) <= 1e-3
                           : !echo.range || *echo.range > cone.nearest_seen();
  if (right) return;
  const bool missed = exact && (!echo.range || *echo.range > *exact);
  ++(missed ? tally.missed : tally.wrong);
  tally.text << std::setprecision(17) << "at " << pose.x << ' ' << pose.y << ' ' << pose.yaw << " heard "
             << echo.range.value_or(-1.0) << ", right is " << exact.value_or(-1.0) << '\n';
}

// Compares `poses` poses, 250 in each of a series of random rooms.
void compare_poses(int poses) {
  Tally ideal, nominal;
  detail::Echo echo;
  for (int seed = 0; ideal.poses < poses; ++seed) {
    RandomStream random(static_cast<std::uint64_t>(seed), "test", "room");
    FurnishedRoom room(random);
    const Caster caster = room.caster();
    for (int i = 0; i < 250; ++i) {
      const Pose2 pose = room.pose(kHalfLobe, kMaxRange, kHeight);
      const std::vector<UprightFace> faces = room.faces_from(pose, kMaxRange, kHeight);
      compare(caster, pose, faces, 90.0 * kDegree, echo, ideal);
      compare(caster, pose, faces, 25.0 * kDegree, echo, nominal);
    }
  }
  for (const Tally* one : {&ideal, &nominal}) {
    const Tally& tally = *one;
    INFO(tally.text.str());
    CHECK(tally.heard > tally.poses / 3);
    CHECK(tally.missed == 0);
    CHECK(tally.wrong == 0);
  }
}

}  // namespace

TEST_CASE("in random poses the nearest echo is that of a cone of 2,001 rays", "[sim][sonar][validation]") {
  compare_poses(orca::test::part_of(20'000));
}

TEST_CASE("in a million random poses the nearest echo is that of a cone of 2,001 rays", "[.][slow]") {
  compare_poses(1'000'000);
}
