// SPDX-License-Identifier: GPL-3.0-or-later
// The systems of a team that a port hears: their names, and the differences of their clocks.
#include "dds/team/senders.hpp"

#include <catch2/catch.hpp>

#include <limits>
#include <random>
#include <string>

using namespace orca;
using dds::of_team::Senders;

namespace {

constexpr TimePoint kZero{std::chrono::hours(500'000)};

}  // namespace

TEST_CASE("instants of a system whose clock is wrong are late by its objects' shortest way at most",
          "[dds][team]") {
  const Duration ahead = GENERATE(Duration(0s), Duration(3s), Duration(-3600s));
  std::mt19937 random(3);
  std::exponential_distribution<double> jitter(1.0 / 0.02);  // [1/s]
  Senders senders;
  Duration shift{};
  for (int i = 0; i < 100; ++i) {
    const TimePoint sent = kZero + i * 100ms;
    const TimePoint came = sent + 2ms + from_seconds(jitter(random));
    shift = senders.note("anna", 1, sent + ahead, came)->shift;
  }
  CHECK(shift + ahead >= 2ms);
  CHECK(shift + ahead <= 3ms);
}

TEST_CASE("a clock that drifts is followed", "[dds][team]") {
  const int sign = GENERATE(1, -1);
  Senders senders;
  Duration shift{};
  const auto ahead_at = [&](int i) { return sign * i * 10us; };  // 100 ppm at ten objects a second
  for (int i = 0; i <= 6000; ++i) {
    const TimePoint came = kZero + i * 100ms;
    shift = senders.note("anna", 1, came + ahead_at(i), came)->shift;
  }
  CHECK(shift + ahead_at(6000) <= 0ms);
  CHECK(shift + ahead_at(6000) >= -6ms);  // what it drifts in a minute
}

TEST_CASE("two systems of one name are told apart until one is silent", "[dds][team]") {
  Senders senders;
  CHECK(senders.note("anna", 1, kZero, kZero)->name == "anna");
  CHECK(senders.note("anna", 20'007, kZero, kZero)->name == "anna#7");
  CHECK(senders.note("anna", 1, kZero, kZero + 500ms)->name == "anna");
  CHECK(senders.note("anna", 20'007, kZero, kZero + 600ms)->name == "anna#7");
  CHECK(senders.note("anna", 20'007, kZero, kZero + 1400ms)->name == "anna#7");
  CHECK(senders.note("anna", 3, kZero, kZero + 1700ms)->name ==
        "anna");  // the first one was silent for long enough
}

TEST_CASE("strangers who call themselves many names take no more than a place each", "[dds][team]") {
  Senders senders;
  for (int i = 0; i < 64; ++i) CHECK(senders.note("x" + std::to_string(i), 1, kZero, kZero));
  CHECK_FALSE(senders.note("one_more", 1, kZero, kZero));
  CHECK(senders.note("x7", 1, kZero, kZero + 900ms));
  CHECK(senders.note("one_more", 1, kZero, kZero + 1100ms));
}

TEST_CASE("an instant may be any number", "[dds][team]") {
  Senders senders;
  for (const std::int64_t number :
       {std::numeric_limits<std::int64_t>::min(), std::numeric_limits<std::int64_t>::max()})
    CHECK(senders.note("anna", 1, TimePoint(Duration(number)), kZero));
}
