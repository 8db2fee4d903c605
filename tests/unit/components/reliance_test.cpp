// SPDX-License-Identifier: GPL-3.0-or-later
// When a behaviour that fell silent may be relied upon again.
#include "motion_command_fuser/voice.hpp"

#include <catch2/catch.hpp>

#include <limits>

using orca::fuse::Reliance;

namespace {

constexpr double kLimit = 0.3;
constexpr double kNever = std::numeric_limits<double>::infinity();

Reliance after_silence() {
  Reliance reliance;
  reliance.heard(kNever, kLimit);
  reliance.look(0.31, kLimit);
  return reliance;
}

}  // namespace

TEST_CASE("a behaviour is relied upon from its first message until it is silent for longer than its limit",
          "[components][fuser]") {
  Reliance reliance;
  CHECK_FALSE(reliance.is_lost());
  reliance.heard(kNever, kLimit);
  reliance.look(0.3, kLimit);
  CHECK_FALSE(reliance.is_lost());
  reliance.look(0.31, kLimit);
  CHECK(reliance.is_lost());
}

TEST_CASE("a lost behaviour is relied upon again after three messages in time", "[components][fuser]") {
  Reliance reliance = after_silence();
  reliance.heard(1.0, kLimit);  // which ends the silence
  for (int i = 0; i < 2; ++i) {
    reliance.heard(0.3, kLimit);
    reliance.look(0.3, kLimit);
    CHECK(reliance.is_lost());
  }
  reliance.heard(0.1, kLimit);
  CHECK_FALSE(reliance.is_lost());
}

TEST_CASE("a late message or another silence starts the count again", "[components][fuser]") {
  const auto late = [](Reliance& reliance) { reliance.heard(0.31, kLimit); };
  const auto silent = [](Reliance& reliance) { reliance.look(0.31, kLimit); };
  for (const auto& disturb : {+late, +silent}) {
    Reliance reliance = after_silence();
    for (int i = 0; i < 2; ++i) reliance.heard(0.1, kLimit);
    disturb(reliance);
    for (int i = 0; i < 2; ++i) reliance.heard(0.1, kLimit);
    CHECK(reliance.is_lost());
    reliance.heard(0.1, kLimit);
    CHECK_FALSE(reliance.is_lost());
  }
}

TEST_CASE("a behaviour that goes on ten times slower stays lost", "[components][fuser]") {
  Reliance reliance = after_silence();
  for (int i = 0; i < 20; ++i) {
    reliance.heard(1.0, kLimit);
    CHECK(reliance.is_lost());
    reliance.look(0.9, kLimit);
  }
}
