// SPDX-License-Identifier: GPL-3.0-or-later
#include "shm/ring.hpp"

#include <catch2/catch.hpp>

#include <algorithm>
#include <cstring>
#include <limits>
#include <random>
#include <thread>
#include <vector>

#include "orca/patterns/shm/ring_segment.hpp"

using namespace orca;
using namespace orca::shm;

namespace {

constexpr std::size_t kCapacity = 4096;
using Bytes = std::vector<std::byte>;

// A fresh ring, with a reader and a writer.
struct Pipe {
  RingSegment segment = RingSegment::map(RingSegment::create("test", kCapacity).value().descriptor()).value();
  Ring ring = ring_in(segment.memory().bytes(), 0);
  RingWriter writer{ring};
  RingReader reader{ring};

  Result<Written> write(const Bytes& bytes) {
    return writer.write([&](std::span<std::byte> to) {
      if (bytes.size() <= to.size()) std::copy(bytes.begin(), bytes.end(), to.begin());
      return bytes.size();
    });
  }
  std::optional<Bytes> read() {
    REQUIRE(reader.look().ok());
    const auto record = reader.next();
    REQUIRE(record.has_value());
    if (!record->has_value()) return std::nullopt;
    Bytes bytes((*record)->begin(), (*record)->end());
    reader.release();
    return bytes;
  }
  // What the reader says to whatever stands in the ring.
  Status verdict() {
    if (Status looked = reader.look(); !looked.ok()) return looked;
    for (;;) {
      const auto record = reader.next();
      if (!record) return record.error();
      if (!record->has_value()) return ok();
      reader.release();
    }
  }
  void put(std::size_t offset, std::uint64_t value) {
    std::memcpy(ring.data.data() + offset, &value, sizeof value);
  }
};

Bytes numbered(std::size_t size, int number) {
  Bytes bytes(size);
  for (std::size_t i = 0; i < size; ++i)
    bytes[i] = static_cast<std::byte>(i * 7 + static_cast<std::size_t>(number));
  return bytes;
}

}  // namespace

TEST_CASE("records are read as they were written, in order, whatever their sizes", "[patterns][shm]") {
  Pipe pipe;
  std::minstd_rand random(GENERATE(1U, 2U, 3U));
  std::vector<Bytes> under_way;
  for (int round = 0; round < 20'000; ++round) {
    const Bytes bytes = numbered(random() % (round % 100 == 0 ? pipe.writer.largest() : 300) + 1, round);
    const Result<Written> written = pipe.write(bytes);
    REQUIRE(written.has_value());
    REQUIRE(*written != Written::too_large);
    if (*written == Written::yes) under_way.push_back(bytes);
    if (*written == Written::no_room) REQUIRE_FALSE(under_way.empty());
    while (!under_way.empty() && (*written == Written::no_room || random() % 3 == 0)) {
      const auto read = pipe.read();
      REQUIRE(read);
      REQUIRE(*read == under_way.front());
      under_way.erase(under_way.begin());
    }
    if (under_way.empty()) REQUIRE_FALSE(pipe.read());
  }
}

TEST_CASE("the largest record finds room in an empty ring, wherever the last one ended", "[patterns][shm]") {
  for (std::size_t before = 8; before <= kCapacity; before += 8) {
    Pipe pipe;
    REQUIRE(pipe.write(numbered(before - 8, 0)).value() == Written::yes);
    REQUIRE(pipe.read());
    const Bytes largest = numbered(pipe.writer.largest(), 1);
    REQUIRE(pipe.write(largest).value() == Written::yes);
    REQUIRE(pipe.read() == largest);
  }
  Pipe pipe;
  CHECK(pipe.write(numbered(pipe.writer.largest() + 1, 0)).value() == Written::too_large);
  CHECK_FALSE(pipe.read());
}

TEST_CASE("a ring that is read as fast as it is written stays at its beginning", "[patterns][shm]") {
  Pipe pipe;
  for (int round = 0; round < 1000; ++round) {
    REQUIRE(pipe.write(numbered(100, round)).value() == Written::yes);
    REQUIRE(pipe.read());
  }
  const auto untouched = pipe.ring.data.subspan(512);
  CHECK(std::all_of(untouched.begin(), untouched.end(), [](std::byte byte) { return byte == std::byte{0}; }));
}

TEST_CASE("a full ring takes nothing, and goes on when it was read", "[patterns][shm]") {
  Pipe pipe;
  int written = 0;
  while (pipe.write(numbered(100, written)).value() == Written::yes) ++written;
  CHECK(written == kCapacity / 112);
  CHECK(pipe.write(numbered(100, written)).value() == Written::no_room);
  for (int round = 0; round < 200; ++round) {
    REQUIRE(pipe.read() == numbered(100, round));
    REQUIRE(pipe.write(numbered(100, written++)).value() == Written::yes);
  }
}

TEST_CASE("a reader overlooks no writer that waits for room", "[patterns][shm]") {
  Pipe pipe;
  CHECK_FALSE(pipe.reader.writer_waits());
  pipe.writer.set_waits(true);
  CHECK(pipe.reader.writer_waits());
  pipe.writer.set_waits(false);
  CHECK_FALSE(pipe.reader.writer_waits());
}

TEST_CASE("a closed ring is news, and what was written before is still read", "[patterns][shm]") {
  Pipe pipe;
  REQUIRE(pipe.write(numbered(10, 1)).value() == Written::yes);
  pipe.writer.close();
  CHECK(pipe.reader.has_news());
  CHECK(pipe.read() == numbered(10, 1));
  CHECK(pipe.reader.has_news());
  CHECK(pipe.reader.is_closed());
}

TEST_CASE("one process may write to a ring while another reads", "[patterns][shm]") {
  Pipe pipe;
  constexpr int kCount = 100'000;
  std::thread writer([&] {
    for (int number = 0; number < kCount;)
      if (pipe.write(numbered(static_cast<std::size_t>(number % 200), number)).value() == Written::yes)
        ++number;
      else
        std::this_thread::yield();
  });
  bool same = true;
  for (int number = 0; number < kCount;) {
    if (!pipe.reader.look().ok()) break;
    const auto record = pipe.reader.next();
    if (!record || !record->has_value()) {
      std::this_thread::yield();
      continue;
    }
    const Bytes expected = numbered(static_cast<std::size_t>(number % 200), number);
    same = same && std::equal(expected.begin(), expected.end(), (*record)->begin(), (*record)->end());
    pipe.reader.release();
    ++number;
  }
  writer.join();
  CHECK(same);
}

TEST_CASE("positions that cannot be are an error of the peer", "[patterns][shm]") {
  const std::uint64_t position =
      GENERATE(std::uint64_t{1}, std::uint64_t{kCapacity + 8}, std::uint64_t{1} << 63,
               std::numeric_limits<std::uint64_t>::max(), std::numeric_limits<std::uint64_t>::max() - 7);
  Pipe pipe;
  pipe.ring.control->written = position;
  const Status read = pipe.verdict();
  REQUIRE_FALSE(read.ok());
  CHECK(read.error().code == Code::data_loss);
  pipe.ring.control->read = position;
  const auto written = pipe.write(numbered(10, 0));
  REQUIRE_FALSE(written.has_value());
  CHECK(written.error().code == Code::data_loss);
}

TEST_CASE("an origin that cannot be is an error of the peer", "[patterns][shm]") {
  const std::uint64_t origin =
      GENERATE(std::uint64_t{8}, std::uint64_t{1}, std::numeric_limits<std::uint64_t>::max());
  Pipe pipe;
  REQUIRE(pipe.write(numbered(100, 0)).value() == Written::yes);
  pipe.ring.control->origin = origin;
  REQUIRE_FALSE(pipe.verdict().ok());
}

TEST_CASE("lengths that cannot be are an error of the peer", "[patterns][shm]") {
  const std::uint64_t kMax = std::numeric_limits<std::uint64_t>::max();
  const std::uint64_t length =
      GENERATE_COPY(std::uint64_t{57}, std::uint64_t{kCapacity}, kMax - 15, kMax - 1, kMax);
  Pipe pipe;
  pipe.put(0, length);
  pipe.ring.control->written = 64;
  REQUIRE_FALSE(pipe.verdict().ok());
}

TEST_CASE("a ring that only skips is an error of the peer, not an endless loop", "[patterns][shm]") {
  Pipe pipe;
  REQUIRE(pipe.write(numbered(100, 0)).value() == Written::yes);
  REQUIRE(pipe.read());
  pipe.put(0, ~std::uint64_t{0});
  pipe.put(112, ~std::uint64_t{0});
  pipe.ring.control->written = 112 + kCapacity;
  REQUIRE_FALSE(pipe.verdict().ok());
}

TEST_CASE("random bytes in a ring give records or an error, but nothing else", "[patterns][shm]") {
  std::mt19937_64 random(GENERATE(range(0U, 50U)));
  for (int round = 0; round < 200; ++round) {
    Pipe pipe;
    for (std::size_t at = 0; at < kCapacity; at += 8)
      pipe.put(at, random() % 3 == 0 ? random() : random() % 600);
    pipe.ring.control->origin = random() % 4 == 0 ? random() : 0;
    pipe.ring.control->written = random() % 4 == 0 ? random() : random() % (kCapacity / 8 + 2) * 8;
    const Status read = pipe.verdict();
    if (!read.ok()) CHECK(read.error().code == Code::data_loss);
    pipe.ring.control->read = random() % 2 == 0 ? random() : 0;
    (void)pipe.write(numbered(100, 0));
  }
}

TEST_CASE("a segment has two rings of a power of two, and nothing else is one", "[patterns][shm]") {
  const auto capacity_of = [](std::size_t asked) {
    return RingSegment::map(RingSegment::create("test", asked).value().descriptor()).value().capacity();
  };
  CHECK(capacity_of(0) == 4096);
  CHECK(capacity_of(4097) == 8192);
  CHECK(capacity_of(RingSegment::kDefaultCapacity) == RingSegment::kDefaultCapacity);
  CHECK_FALSE(RingSegment::create("test", (std::size_t{1} << 30) + 1));
  for (const std::size_t size : {std::size_t{1}, kControlSize, kControlSize + 8, kControlSize + 2 * 4096 + 1,
                                 kControlSize + 2 * 6000, kControlSize + 2 * 2048}) {
    const auto mapped = RingSegment::map(MemoryFile::create("test", size).value().descriptor());
    REQUIRE_FALSE(mapped.has_value());
    CHECK(mapped.error().code == Code::invalid_argument);
  }
}
