// SPDX-License-Identifier: GPL-3.0-or-later
#include <catch2/catch.hpp>

#include "allocation_counter.hpp"
#include "toy_protocol.hpp"

using namespace orca::hw;

TEST_CASE("a scanner takes memory when it is made, and none for frames or garbage", "[hw][framing]") {
  orca::RandomStream random(4, "test", "scanner");
  toy::Bytes stream = toy::noise(random, 1000);
  for (int i = 0; i < 100; ++i) {
    const toy::Bytes frame = toy::frame_of(toy::noise(random, 20));
    stream.insert(stream.end(), frame.begin(), frame.end());
  }
  framing::Scanner scanner(toy::kProtocol);
  std::size_t frames = 0;
  const long before = orca::test::allocations();
  scanner.feed(stream, [&](const framing::Frame&) { ++frames; });
  scanner.give_up([&](const framing::Frame&) { ++frames; });
  CHECK(orca::test::allocations() == before);
  CHECK(frames == 100);
}
