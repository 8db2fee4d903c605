// SPDX-License-Identifier: GPL-3.0-or-later
#include "orca/base/hash.hpp"

#include <catch2/catch.hpp>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include "orca/base/random.hpp"

using orca::Fnv1a;

namespace {

std::uint64_t hash_of_bytes(std::span<const std::byte> bytes) {
  Fnv1a hash;
  hash.add(bytes);
  return hash.value();
}

}  // namespace

TEST_CASE("the hash has the values of the draft for known texts", "[base]") {
  const auto of = [](std::string_view text) { return hash_of_bytes(std::as_bytes(std::span(text))); };
  CHECK(of("") == 0xcbf29ce484222325ULL);
  CHECK(of("a") == 0xaf63dc4c8601ec8cULL);
  CHECK(of("foobar") == 0x85944171f73967e8ULL);
}

TEST_CASE("the hash of bytes with long runs of zeros is that of each byte in turn", "[base]") {
  orca::RandomStream random(1, "hash_test", "bytes");
  for (int round = 0; round < 500; ++round) {
    std::vector<std::byte> bytes(static_cast<std::size_t>(random.uniform(0.0, 80.0)));
    for (std::byte& byte : bytes)
      if (random.uniform(0.0, 1.0) < 0.05) byte = static_cast<std::byte>(random.uniform(1.0, 256.0));
    Fnv1a expected;
    for (const std::byte& byte : bytes) expected.add(std::span(&byte, 1));
    CHECK(hash_of_bytes(bytes) == expected.value());
  }
}
