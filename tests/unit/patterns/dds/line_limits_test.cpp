// SPDX-License-Identifier: GPL-3.0-or-later
// How often a line writes, how much it keeps and when it gives up. The test plays the peer and hears each message.
#include <catch2/catch.hpp>

#include <set>

#include "dds/backend/line.hpp"

using namespace orca;
using namespace orca::dds;
using frames::Loss;
using frames::Sent;

namespace {

constexpr std::uint64_t kSeat = 7;      // the edge
constexpr std::uint64_t kPeerName = 2;  // hash of the peer's name
constexpr std::uint64_t kPeerNumber = 1;
constexpr std::size_t kMebi = std::size_t{1} << 20;
using Ticks = std::vector<int>;

struct Counter final : Passenger {
  void boarded(std::uint64_t new_session) override { session = new_session; }
  void arrived(Parcel kind, std::span<const std::byte> /*contents*/) override {
    frames += kind == Parcel::frame;
  }
  void line_lost(const Error& reason) override { why_lost = reason.message; }
  void line_joined(std::uint64_t /*session*/) override {}
  std::size_t frames = 0;
  std::uint64_t session = 0;
  std::string why_lost;
};

// A parcel of that many bytes.
std::vector<std::byte> parcel_of(std::size_t bytes) {
  std::vector<std::byte> parcel = begin_parcel(kSeat, Parcel::frame);
  parcel.resize(bytes);
  return parcel;
}

// A line and what it has written.
struct Talk {
  struct Written {
    std::uint64_t own, peer, sequence, received;
    std::size_t bytes;
  };

  explicit Talk(Duration liveliness = 10s)
      : line("far", Line::Settings{1, liveliness}, [this](const std::vector<std::byte>& bytes, By) {
          std::span<const std::byte> rest = bytes;
          const auto message = take_message(rest);
          REQUIRE(message);
          written.push_back(
              {message->own, message->peer, message->sequence, message->received, message->parcel.size()});
        }) {
    line.add(kSeat, counter);
    session = counter.session;
  }

  // Lets the peer say something.
  void hear(std::uint64_t sequence = 0, std::uint64_t received = 0) {
    const std::vector<std::byte> parcel = sequence == 0 ? std::vector<std::byte>{} : parcel_of(100);
    const std::vector<std::byte> bytes = encode({kPeerName, kPeerNumber, own, sequence, received, parcel});
    std::span<const std::byte> rest = bytes;
    line.receive(*take_message(rest), Origin{std::byte{2}});
  }

  void join() {
    line.greet_if_alone();
    own = written.back().own;
    hear();
    REQUIRE(line.is_joined());
    written.clear();
  }

  // Returns the ticks, of so many, in which a message was written that has a certain property.
  template <class Property>
  Ticks ticks_with(
      int count, const Property& property, const std::function<void()>& before_each = [] {}) {
    Ticks ticks;
    for (int tick = 1; tick <= count; ++tick) {
      before_each();
      written.clear();
      line.tick();
      if (std::ranges::any_of(written, property)) ticks.push_back(tick);
    }
    return ticks;
  }

  Sent send(std::size_t bytes, Loss loss = Loss::never) { return line.send(parcel_of(bytes), session, loss); }

  std::vector<Written> written;
  std::uint64_t own = 0;
  std::uint64_t session = 0;
  Counter counter;
  Line line;
};

// One whose peer has joined.
struct JoinedTalk : Talk {
  explicit JoinedTalk(Duration liveliness = 10s) : Talk(liveliness) { join(); }
};

bool is_parcel_1(const Talk::Written& one) { return one.sequence == 1; }
bool is_anything(const Talk::Written& /*one*/) { return true; }

}  // namespace

TEST_CASE("each line takes part under a random number of its own, which is not 0", "[patterns][dds]") {
  std::set<std::uint64_t> numbers, halves;
  for (int i = 0; i < 20; ++i) {
    Talk talk;
    talk.line.greet_if_alone();
    numbers.insert(talk.written.at(0).own);
    halves.insert(talk.written.at(0).own >> 32);
    CHECK(talk.written.at(0).peer == 0);  // it knows none yet
  }
  CHECK(numbers.size() == 20);
  CHECK(halves.size() == 20);
  CHECK_FALSE(numbers.contains(0));
}

TEST_CASE("a line without a peer greets at each tick for two seconds, and at each fifth tick afterwards",
          "[patterns][dds]") {
  Talk talk;
  Ticks expected;
  for (int tick = 1; tick < 100; ++tick) expected.push_back(tick);
  for (int tick = 100; tick <= 120; tick += 5) expected.push_back(tick);
  CHECK(talk.ticks_with(120, is_anything) == expected);
}

TEST_CASE("a line with nothing to say gives a sign of life at each second tick", "[patterns][dds]") {
  JoinedTalk talk;
  CHECK(talk.ticks_with(10, is_anything) == Ticks{2, 4, 6, 8, 10});
}

TEST_CASE("what has arrived is confirmed at the next tick", "[patterns][dds]") {
  JoinedTalk talk;
  talk.hear(1);
  const auto confirms = [](const Talk::Written& one) { return one.received == 1; };
  CHECK(talk.ticks_with(1, confirms) == Ticks{1});
  CHECK(talk.ticks_with(2, confirms) == Ticks{2});  // confirmed once; then only the sign of life repeats it
}

TEST_CASE(
    "a parcel that is not confirmed is repeated after three ticks, then ever more rarely, twice a second at "
    "last",
    "[patterns][dds]") {
  JoinedTalk talk;
  REQUIRE(talk.send(100) == Sent::yes);
  const auto lives = [&] { talk.hear(); };
  CHECK(talk.ticks_with(100, is_parcel_1, lives) == Ticks{4, 10, 22, 46, 71, 96});
  talk.hear(0, 1);  // once the peer confirms again, the line is as quick as at first
  REQUIRE(talk.send(100) == Sent::yes);
  const auto is_parcel_2 = [](const Talk::Written& one) { return one.sequence == 2; };
  CHECK(talk.ticks_with(10, is_parcel_2, lives) == Ticks{4, 10});
}

TEST_CASE("a parcel that was confirmed is not repeated", "[patterns][dds]") {
  JoinedTalk talk;
  REQUIRE(talk.send(100) == Sent::yes);
  talk.hear(0, 1);
  CHECK(talk.ticks_with(20, is_parcel_1).empty());
}

TEST_CASE("a receipt for more than was sent means nothing", "[patterns][dds]") {
  JoinedTalk talk;
  REQUIRE(talk.send(100) == Sent::yes);
  talk.hear(0, 2);
  CHECK(talk.ticks_with(4, is_parcel_1) == Ticks{4});
}

TEST_CASE("a line repeats as many parcels at once as are begun within a mebibyte", "[patterns][dds]") {
  JoinedTalk talk;
  for (int i = 0; i < 12; ++i) REQUIRE(talk.send(kMebi / 4) == Sent::yes);
  REQUIRE(talk.ticks_with(4, is_parcel_1) == Ticks{4});
  std::vector<std::uint64_t> repeated;
  for (const Talk::Written& one : talk.written)
    if (one.sequence != 0) repeated.push_back(one.sequence);
  CHECK(repeated == std::vector<std::uint64_t>{1, 2, 3, 4, 5});
}

TEST_CASE("what may be lost is refused while more than 4 MiB are not confirmed", "[patterns][dds]") {
  JoinedTalk talk;
  for (int i = 0; i < 5; ++i) CHECK(talk.send(kMebi, Loss::allowed) == Sent::yes);
  CHECK(talk.send(kMebi, Loss::allowed) == Sent::no_room);
  CHECK(talk.send(kMebi) == Sent::yes);
  talk.hear(0, 2);  // leaves 4 MiB
  CHECK(talk.send(kMebi, Loss::allowed) == Sent::yes);
  CHECK(talk.send(kMebi, Loss::allowed) == Sent::no_room);
}

TEST_CASE("a parcel has 32 MiB at most", "[patterns][dds]") {
  Talk talk;
  CHECK(talk.send(32 * kMebi + 1) == Sent::too_large);
  CHECK(talk.send(32 * kMebi) == Sent::yes);
}

TEST_CASE("a peer that lives but confirms nothing is lost as soon as more than 64 MiB wait for it",
          "[patterns][dds]") {
  JoinedTalk talk;
  REQUIRE(talk.send(32 * kMebi) == Sent::yes);
  REQUIRE(talk.send(32 * kMebi) == Sent::yes);
  talk.line.tick();
  CHECK(talk.line.is_joined());
  REQUIRE(talk.send(100) == Sent::yes);
  talk.hear();
  talk.line.tick();
  CHECK_FALSE(talk.line.is_joined());
}

TEST_CASE("256 parcels behind a missing one are kept, and more have to be repeated", "[patterns][dds]") {
  JoinedTalk talk;
  for (std::uint64_t sequence = 2; sequence <= 300; ++sequence) talk.hear(sequence);
  CHECK(talk.counter.frames == 0);
  talk.hear(1);
  CHECK(talk.counter.frames == 257);
  for (std::uint64_t sequence = 258; sequence <= 300; ++sequence) talk.hear(sequence);
  CHECK(talk.counter.frames == 300);
}

TEST_CASE("a peer is lost in the first tick after its liveliness time, and the reason says how long that is",
          "[patterns][dds]") {
  JoinedTalk talk(300ms);
  for (int tick = 1; tick <= 15; ++tick) talk.line.tick();
  CHECK(talk.line.is_joined());
  talk.line.tick();
  CHECK_FALSE(talk.line.is_joined());
  CHECK(talk.counter.why_lost == "process far has given no sign of life for 300 ms");
}

TEST_CASE("a line that has lost its peer takes part under another number, and greets it quickly again",
          "[patterns][dds]") {
  JoinedTalk talk;
  const std::uint64_t before = talk.own;
  talk.line.lose(fail(Code::unavailable, "it is said to be gone"));
  CHECK(talk.counter.why_lost == "it is said to be gone");
  talk.counter.why_lost.clear();
  talk.line.lose(fail(Code::unavailable, "it is gone already"));
  CHECK(talk.counter.why_lost.empty());
  CHECK(talk.ticks_with(3, [&](const Talk::Written& one) { return one.own != before && one.peer == 0; }) ==
        Ticks{1, 2, 3});
}
