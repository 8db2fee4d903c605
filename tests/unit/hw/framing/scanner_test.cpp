// SPDX-License-Identifier: GPL-3.0-or-later
#include <catch2/catch.hpp>

#include <functional>
#include <vector>

#include "toy_protocol.hpp"

using namespace orca::hw;
using toy::Bytes;

namespace {

// Frames with their bodies of known sums: of {1} it is 1 * 251 + 1 = 00FC, of {2} 00FD.
const Bytes kOne{0xA5, 0x01, 0x01, 0x00, 0xFC};
const Bytes kTwo{0xA5, 0x01, 0x02, 0x00, 0xFD};

struct Seen {
  Bytes bytes;
  std::uint64_t begin = 0;
  std::uint64_t skipped = 0;
  friend bool operator==(const Seen&, const Seen&) = default;
};

// A scanner with a list of what it has found.
class Ear {
 public:
  void hear(const Bytes& bytes) { scanner.feed(bytes, note_); }
  void give_up() { scanner.give_up(note_); }

  framing::Scanner scanner{toy::kProtocol};
  std::vector<Seen> seen;

 private:
  const std::function<void(const framing::Frame&)> note_ = [this](const framing::Frame& frame) {
    seen.push_back({Bytes(frame.bytes.begin(), frame.bytes.end()), frame.begin, frame.skipped});
  };
};

Bytes joined(std::initializer_list<Bytes> parts) {
  Bytes all;
  for (const Bytes& part : parts) all.insert(all.end(), part.begin(), part.end());
  return all;
}

}  // namespace

TEST_CASE("two frames in one read are both found, each with the index of its first byte", "[hw][framing]") {
  Ear ear;
  ear.hear(joined({kOne, kTwo}));
  CHECK(ear.seen == std::vector<Seen>{{kOne, 0, 0}, {kTwo, 5, 0}});
  CHECK(ear.scanner.received() == 10);
  CHECK(ear.scanner.waiting() == 0);
}

TEST_CASE("a frame that arrives one byte at a time is found with its last byte", "[hw][framing]") {
  Ear ear;
  for (std::size_t i = 0; i < kOne.size(); ++i) {
    CHECK(ear.seen.empty());
    ear.hear({kOne[i]});
  }
  CHECK(ear.seen == std::vector<Seen>{{kOne, 0, 0}});
}

TEST_CASE("noise before a frame is skipped and counted", "[hw][framing]") {
  Ear ear;
  ear.hear(joined({{'W', 'M', 'S', '2', '\r'}, kOne, kTwo}));
  CHECK(ear.seen == std::vector<Seen>{{kOne, 5, 5}, {kTwo, 10, 0}});
  CHECK(ear.scanner.statistics() == framing::Statistics{2, 0, 5, 1});
}

TEST_CASE("after a bad checksum the scanner goes on from the byte after the false beginning",
          "[hw][framing]") {
  Bytes outer = toy::frame_of(kOne);
  outer.back() ^= 0x01;  // the frame inside is good all the same
  Ear ear;
  ear.hear(joined({outer, kTwo}));
  CHECK(ear.seen == std::vector<Seen>{{kOne, 2, 2}, {kTwo, 9, 2}});
  CHECK(ear.scanner.statistics() == framing::Statistics{2, 1, 4, 2});
}

TEST_CASE("a frame inside the body of a good frame is not taken for one", "[hw][framing]") {
  Ear ear;
  ear.hear(toy::frame_of(kOne));
  CHECK(ear.seen == std::vector<Seen>{{toy::frame_of(kOne), 0, 0}});
}

TEST_CASE("a frame that was cut short hides the next ones only until its promised length has come",
          "[hw][framing]") {
  Ear ear;
  ear.hear({0xA5, 0x09, 0x01});  // promises 9 bytes and a sum
  ear.hear(joined({kOne}));
  CHECK(ear.seen.empty());
  ear.hear(kTwo);
  CHECK(ear.seen == std::vector<Seen>{{kOne, 3, 3}, {kTwo, 8, 0}});
}

TEST_CASE("giving up a frame whose end is missing gives the frames inside it", "[hw][framing]") {
  Ear ear;
  ear.hear(joined({{0xA5, 0x3C}, kOne, {0xA5, 0x3C, 0x00}}));
  CHECK(ear.seen.empty());
  CHECK(ear.scanner.waiting() == 10);
  ear.give_up();
  CHECK(ear.seen == std::vector<Seen>{{kOne, 2, 2}});
  CHECK(ear.scanner.waiting() == 0);
  CHECK(ear.scanner.statistics() == framing::Statistics{1, 0, 5, 1});
  ear.hear(kTwo);
  CHECK(ear.seen.back() == Seen{kTwo, 10, 3});
}

TEST_CASE("the end of the stream in mid-frame gives no frame", "[hw][framing]") {
  Ear ear;
  ear.hear({0xA5, 0x01, 0x01, 0x00});
  ear.give_up();
  CHECK(ear.seen.empty());
  CHECK(ear.scanner.statistics() == framing::Statistics{0, 0, 4, 0});
}

TEST_CASE("a protocol that never has enough bytes is not waited for longer than its longest frame",
          "[hw][framing]") {
  const auto insatiable = [](std::span<const std::uint8_t>) {
    return framing::Finding{framing::Finding::Kind::need_more};
  };
  framing::Scanner scanner({.look = insatiable, .longest = 8});
  int frames = 0;
  scanner.feed(Bytes(1000, 0xA5), [&](const framing::Frame&) { ++frames; });
  CHECK(frames == 0);
  CHECK(scanner.waiting() == 7);
  CHECK(scanner.statistics().skipped_bytes == 993);
}

TEST_CASE("a frame of no bytes, or of more than there are, is not believed", "[hw][framing]") {
  const auto liar = [](std::span<const std::uint8_t> bytes) {
    return framing::Finding{framing::Finding::Kind::frame, bytes[0] == 0 ? 0 : bytes.size() + 1};
  };
  framing::Scanner scanner({.look = liar, .longest = 8});
  int frames = 0;
  scanner.feed(Bytes{0, 1, 0, 1}, [&](const framing::Frame&) { ++frames; });
  CHECK(frames == 0);
  CHECK(scanner.statistics().skipped_bytes == 4);
}
