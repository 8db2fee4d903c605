// SPDX-License-Identifier: GPL-3.0-or-later
#include <catch2/catch.hpp>

#include <algorithm>
#include <utility>
#include <vector>

#include "toy_protocol.hpp"

using namespace orca::hw;
using orca::RandomStream;
using toy::Bytes;

namespace {

using Places = std::vector<std::pair<std::uint64_t, std::size_t>>;  // index of the first byte, size

// The frames of a stream that is known as a whole: at each place the first that fits, then on behind it.
Places expected_places(const Bytes& stream) {
  Places places;
  for (std::size_t at = 0; at < stream.size();) {
    const auto finding = toy::look(std::span(stream).subspan(at));
    const bool is_frame = finding.kind == framing::Finding::Kind::frame;
    if (is_frame) places.emplace_back(at, finding.size);
    at += is_frame ? finding.size : 1;
  }
  return places;
}

Places places_in_pieces(const Bytes& stream, RandomStream& random, std::size_t longest_piece) {
  framing::Scanner scanner(toy::kProtocol);
  Places places;
  const auto sink = [&](const framing::Frame& frame) {
    places.emplace_back(frame.begin, frame.bytes.size());
  };
  for (std::size_t at = 0; at < stream.size();) {
    const std::size_t size = std::min(toy::number(random, 1, longest_piece), stream.size() - at);
    scanner.feed(std::span(stream).subspan(at, size), sink);
    at += size;
  }
  scanner.give_up(sink);
  return places;
}

void append(Bytes& stream, const Bytes& bytes) { stream.insert(stream.end(), bytes.begin(), bytes.end()); }

// Bytes that look like beginnings of frames more often than chance would have it.
Bytes treacherous_noise(RandomStream& random) {
  Bytes bytes = toy::noise(random, toy::number(random, 0, 40));
  for (auto& byte : bytes) {
    if (random.chance(0.2)) byte = toy::kStart;
    if (random.chance(0.2)) byte %= 64;
  }
  return bytes;
}

}  // namespace

TEST_CASE("good frames between garbage are found however the stream is cut", "[hw][framing]") {
  RandomStream random(1, "test", "scanner");
  std::size_t swallowed = 0;
  for (int round = 0; round < 300; ++round) {
    Bytes stream;
    Places sent;
    for (int i = 0; i < 20; ++i) {
      append(stream, treacherous_noise(random));
      const Bytes frame = toy::frame_of(toy::noise(random, toy::number(random, 1, toy::kLongestBody)));
      sent.emplace_back(stream.size(), frame.size());
      append(stream, frame);
    }
    const Places expected = expected_places(stream);
    CHECK(places_in_pieces(stream, random, 1) == expected);
    CHECK(places_in_pieces(stream, random, 7) == expected);
    CHECK(places_in_pieces(stream, random, 1000) == expected);
    for (const auto& place : sent) swallowed += std::ranges::find(expected, place) == expected.end();
  }
  CHECK(swallowed == 0);  // of 6000; garbage forms a good frame once in 65536 tries
}

TEST_CASE("after garbage, the first frame is known at the latest with the longest frame behind it",
          "[hw][framing]") {
  RandomStream random(2, "test", "scanner");
  for (int round = 0; round < 1000; ++round) {
    framing::Scanner scanner(toy::kProtocol);
    std::vector<std::uint64_t> begins;
    const auto sink = [&](const framing::Frame& frame) { begins.push_back(frame.begin); };
    const Bytes garbage = treacherous_noise(random);
    scanner.feed(garbage, sink);
    // Frames as long as the longest: a false beginning is refuted before the second of them is complete.
    for (int i = 0; i < 2; ++i) scanner.feed(toy::frame_of(Bytes(toy::kLongestBody, 0x11)), sink);
    REQUIRE(begins.size() == 2);
    CHECK(begins[0] == garbage.size());
  }
}

TEST_CASE("of a million frames with one in a hundred corrupted no good one is lost", "[hw][framing]") {
  RandomStream random(3, "test", "scanner");
  framing::Scanner scanner(toy::kProtocol);
  std::size_t good = 0;
  std::size_t corrupted = 0;
  std::size_t found = 0;
  std::size_t false_ones = 0;
  std::vector<std::uint64_t> awaited;  // beginnings of good frames that were not found yet, in order
  std::size_t next_awaited = 0;
  const auto sink = [&](const framing::Frame& frame) {
    const bool is_next = next_awaited < awaited.size() && awaited[next_awaited] == frame.begin;
    is_next ? ++found : ++false_ones;
    next_awaited += is_next ? 1 : 0;
  };
  for (int i = 0; i < 1'000'000; ++i) {
    Bytes frame = toy::frame_of(toy::noise(random, toy::number(random, 1, 16)));
    if (random.chance(0.01)) {
      frame[toy::number(random, 0, frame.size() - 1)] ^=
          static_cast<std::uint8_t>(toy::number(random, 1, 255));
      ++corrupted;
    } else {
      awaited.push_back(scanner.received());
      ++good;
    }
    scanner.feed(frame, sink);
  }
  scanner.give_up(sink);
  CHECK(corrupted > 9000);
  CHECK(found == good);
  CHECK(false_ones == 0);
  CHECK(scanner.statistics().frames == good);
  CHECK(scanner.statistics().resynchronisations <= corrupted);
}
