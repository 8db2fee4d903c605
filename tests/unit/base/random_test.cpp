// SPDX-License-Identifier: GPL-3.0-or-later
#include <catch2/catch.hpp>

#include <cmath>

#include "orca/base/random.hpp"

using orca::RandomStream;

TEST_CASE("a random stream is fixed by seed, component and name, and by nothing else", "[base][random]") {
  RandomStream a(1, "scout", "sonar");
  RandomStream b(1, "scout", "sonar");
  RandomStream other_seed(2, "scout", "sonar");
  RandomStream other_name(1, "scout", "sona");
  RandomStream shifted(1, "scou", "tsonar");
  const auto first = a();
  CHECK(first == b());
  CHECK(first != other_seed());
  CHECK(first != other_name());
  CHECK(first != shifted());
}

// Computed by a second implementation (Python) that gives the published values of SplitMix64 (seed 1234567) and of
// xoshiro256++ (state 1, 2, 3, 4). Published results depend on these numbers.
TEST_CASE("a random stream is xoshiro256++, seeded by SplitMix64 from the hash of its key",
          "[base][random]") {
  RandomStream stream(1, "scout", "sonar");
  for (const std::uint64_t expected : {0xe81d21b3ac73d7e8U, 0x1cf2898dc893ffdfU, 0xc0826940c22e3214U,
                                       0x119b2823731f485fU, 0x453fd4544c131bc4U})
    CHECK(stream() == expected);
}

TEST_CASE("all 64 bits of a random stream are random, and it says so to the standard library",
          "[base][random]") {
  CHECK(RandomStream::min() == 0);
  CHECK(RandomStream::max() == ~std::uint64_t{0});
  RandomStream stream(3, "test", "bits");
  std::uint64_t set = 0, always_set = RandomStream::max();
  for (int i = 0; i < 200; ++i) {
    const std::uint64_t number = stream();
    set |= number;
    always_set &= number;
  }
  CHECK(set == RandomStream::max());
  CHECK(always_set == 0);
}

TEST_CASE("uniform stays in its interval and normal has the asked mean and deviation", "[base][random]") {
  RandomStream stream(7, "test", "moments");
  double sum = 0.0;
  double squares = 0.0;
  constexpr int kDraws = 200000;
  for (int i = 0; i < kDraws; ++i) {
    const double u = stream.uniform(-1.0, 3.0);
    REQUIRE(u >= -1.0);
    REQUIRE(u < 3.0);
    const double n = stream.normal(5.0, 2.0);
    sum += n;
    squares += (n - 5.0) * (n - 5.0);
  }
  // Five standard errors: 5 * 2 / sqrt(200000) = 0.022.
  CHECK(std::abs(sum / kDraws - 5.0) < 0.023);
  CHECK(std::abs(std::sqrt(squares / kDraws) - 2.0) < 0.016);
}
