// SPDX-License-Identifier: GPL-3.0-or-later
#include <catch2/catch.hpp>
#include <cstdint>
#include <limits>

#include "orca/patterns/update_rate.hpp"

using namespace orca;

TEST_CASE("a regular server grants the next multiple of its base period", "[patterns][rate]") {
  CHECK(grant_rate({0s, 1}, 50ms) == UpdateGrant{50ms, 1, 50ms});
  CHECK(grant_rate({50ms, 1}, 50ms) == UpdateGrant{50ms, 1, 50ms});
  CHECK(grant_rate({51ms, 1}, 50ms) == UpdateGrant{50ms, 2, 100ms});
  CHECK(grant_rate({100ms, 1}, 50ms) == UpdateGrant{50ms, 2, 100ms});
  CHECK(grant_rate({0s, 4}, 50ms) == UpdateGrant{50ms, 4, 200ms});
}

TEST_CASE("whoever asks for nothing special gets every object", "[patterns][rate]") {
  CHECK(grant_rate({}, 50ms) == UpdateGrant{50ms, 1, 50ms});
  CHECK(grant_rate({}, 0s) == UpdateGrant{0s, 1, 0s});
  CHECK(UpdateGrant{} == UpdateGrant{0s, 1, 0s});
}

TEST_CASE("the slower of an interval and a multiple is granted", "[patterns][rate]") {
  CHECK(grant_rate({100ms, 3}, 50ms).multiple == 3);
  CHECK(grant_rate({200ms, 3}, 50ms).multiple == 4);
}

TEST_CASE("a thousandth of a period more than a multiple does not cost a whole period", "[patterns][rate]") {
  const Duration third = from_seconds(1.0 / 30.0);  // 33.333333 ms
  CHECK(grant_rate({100ms, 1}, third).multiple == 3);
  CHECK(grant_rate({101ms, 1}, third).multiple == 4);
}

TEST_CASE("an irregular server grants what is asked for", "[patterns][rate]") {
  CHECK(grant_rate({0s, 1}, 0s) == UpdateGrant{0s, 1, 0s});
  CHECK(grant_rate({70ms, 2}, 0s) == UpdateGrant{0s, 2, 70ms});
}

TEST_CASE("impossible requests are granted as the nearest possible ones", "[patterns][rate]") {
  CHECK(grant_rate({0s, 0}, 50ms).multiple == 1);
  CHECK(grant_rate({-1s, 1}, 50ms).multiple == 1);
  CHECK(grant_rate({24h * 365 * 100, 1}, 1ns).multiple == 1'000'000'000);
  CHECK(grant_rate({Duration::max(), 1}, 50ms).multiple == 1'000'000'000);
  CHECK(grant_rate({Duration::min(), 1}, 50ms).multiple == 1);
  const Duration half = Duration::max() / 2;
  CHECK(grant_rate({0s, 2}, half).interval == 2 * half);
  CHECK(grant_rate({0s, 2}, half + 1ns).interval == Duration::max());
  CHECK(grant_rate({0s, std::numeric_limits<std::uint32_t>::max()}, 1h).interval == Duration::max());
}
