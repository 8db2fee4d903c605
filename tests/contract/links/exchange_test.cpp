// SPDX-License-Identifier: GPL-3.0-or-later
// Bytes go over every link in order and complete, and no function waits for the other end.
#include <catch2/catch.hpp>

#include "link_kits.hpp"
#include "orca/base/random.hpp"

using namespace orca;
using namespace orca::test;
using hw::link::kMostPending;

namespace {

Bytes numbered(std::size_t count, std::uint8_t first) {
  Bytes bytes(count);
  for (std::size_t i = 0; i < count; ++i) bytes[i] = static_cast<std::uint8_t>(first + i + i / 256);
  return bytes;
}

// Sends bytes one way in pieces of random sizes, as fast as the other end reads them.
class OneWay {
 public:
  OneWay(hw::link::ByteLink& from, hw::link::ByteLink& to, Bytes bytes, const char* name)
      : from_(from), to_(to), bytes_(std::move(bytes)), random_(7, "links", name) {}

  // Returns whether all has arrived.
  bool step() {
    const std::size_t left = bytes_.size() - sent_;
    const std::size_t size = std::min<std::size_t>(left, 1 + random_() % 700);
    if (under_way() < 4000 && from_.write(std::span(bytes_).subspan(sent_, size)).ok()) sent_ += size;
    const Bytes some = read_some(to_, 1 + random_() % 300);
    arrived_.insert(arrived_.end(), some.begin(), some.end());
    return arrived_.size() >= bytes_.size();
  }
  [[nodiscard]] bool is_complete() const { return arrived_ == bytes_; }

 private:
  [[nodiscard]] std::size_t under_way() const { return sent_ - arrived_.size(); }

  hw::link::ByteLink& from_;
  hw::link::ByteLink& to_;
  const Bytes bytes_;
  RandomStream random_;
  std::size_t sent_ = 0;
  Bytes arrived_;
};

// Writes numbered packets of 64 bytes until one is refused, and returns how many were taken.
std::size_t fill(hw::link::ByteLink& link, Code& refusal) {
  constexpr std::size_t kMostPackets = 200'000;
  for (std::size_t count = 0; count < kMostPackets; ++count) {
    const Status written = link.write(numbered(64, static_cast<std::uint8_t>(count)));
    if (written.ok()) continue;
    refusal = written.error().code;
    return count;
  }
  return kMostPackets;
}

}  // namespace

TEMPLATE_TEST_CASE("bytes from the device arrive in order and complete, in whatever pieces they come",
                   "[hw][link]", ORCA_LINK_KITS) {
  TestType kit;
  kit.connect();
  OneWay inwards(*kit.device, *kit.link, numbered(30'000, 1), "in");
  CHECK(soon([&] { return inwards.step(); }));
  CHECK(inwards.is_complete());
}

TEMPLATE_TEST_CASE("bytes go both ways at once", "[hw][link]", ORCA_LINK_KITS) {
  TestType kit;
  kit.connect();
  OneWay inwards(*kit.device, *kit.link, numbered(20'000, 3), "in");
  OneWay outwards(*kit.link, *kit.device, numbered(20'000, 5), "out");
  CHECK(soon([&] {
    const bool in = inwards.step();
    const bool out = outwards.step();
    return in && out;
  }));
  CHECK(inwards.is_complete());
  CHECK(outwards.is_complete());
}

TEMPLATE_TEST_CASE("all 256 values of a byte go over the line as they are", "[hw][link]", ORCA_LINK_KITS) {
  TestType kit;
  kit.connect();
  Bytes all(256);
  for (std::size_t i = 0; i < all.size(); ++i) all[i] = static_cast<std::uint8_t>(i);
  must_write(*kit.link, all);
  CHECK(read_bytes(*kit.device, 256) == all);
  must_write(*kit.device, all);
  CHECK(read_bytes(*kit.link, 256) == all);
}

TEMPLATE_TEST_CASE("a device that takes nothing delays nobody: whole packets are refused, and none is cut",
                   "[hw][link]", ORCA_LINK_KITS) {
  TestType kit;
  kit.connect();
  Code refusal = Code::internal;
  std::size_t taken = fill(*kit.link, refusal);
  REQUIRE(taken > 0);
  CHECK(refusal == Code::deadline_exceeded);
  CHECK(taken * 64 < 100'000);  // so that no device gets commands that are minutes old
  CHECK((kit.link->pending() > 0) == TestType::kTellsPending);
  CHECK(kit.link->flush().ok());

  // As soon as the device takes something, there is room for the next packet.
  Bytes arrived;
  CHECK(soon([&] {
    const Bytes some = read_some(*kit.device);
    arrived.insert(arrived.end(), some.begin(), some.end());
    return kit.link->write(numbered(64, static_cast<std::uint8_t>(taken))).ok();
  }));
  ++taken;
  CHECK(soon([&] {
    const Bytes some = read_some(*kit.device);
    arrived.insert(arrived.end(), some.begin(), some.end());
    (void)kit.link->flush();
    return arrived.size() == taken * 64;
  }));
  for (std::size_t i = 0; i < taken && arrived.size() == taken * 64; ++i) {
    const auto at = arrived.begin() + static_cast<std::ptrdiff_t>(i * 64);
    if (Bytes(at, at + 64) != numbered(64, static_cast<std::uint8_t>(i)))
      FAIL("packet " << i << " is damaged");
  }
  must_write(*kit.link, bytes_of("goes on"));
  CHECK(text_of(read_bytes(*kit.device, 7)) == "goes on");
}

TEMPLATE_TEST_CASE("a write of more than a link can keep is a mistake and sends nothing", "[hw][link]",
                   ORCA_LINK_KITS) {
  TestType kit;
  kit.connect();
  const Status written = kit.link->write(numbered(kMostPending + 1, 0));
  REQUIRE_FALSE(written.ok());
  CHECK(written.error().code == Code::invalid_argument);
  must_write(*kit.link, bytes_of("ab"));
  CHECK(text_of(read_bytes(*kit.device, 2)) == "ab");
}

TEMPLATE_TEST_CASE("nothing to write and no room to read are no errors", "[hw][link]", ORCA_LINK_KITS) {
  TestType kit;
  kit.connect();
  must_write(*kit.link, {});
  must_write(*kit.device, bytes_of("a"));
  CHECK(*kit.link->read({}) == 0);
  CHECK(text_of(read_bytes(*kit.link, 1)) == "a");
}
