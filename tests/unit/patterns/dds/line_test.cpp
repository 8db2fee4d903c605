// SPDX-License-Identifier: GPL-3.0-or-later
// What two processes say to each other over a network that loses, doubles and delays.
#include "dds/backend/line.hpp"

#include <catch2/catch.hpp>

#include <deque>
#include <random>

using namespace orca;
using namespace orca::dds;
using frames::Loss;
using frames::Sent;

namespace {

constexpr std::uint64_t kEdge = 7;
constexpr std::uint64_t kFarId = 2;
constexpr Origin kNearOrigin{std::byte{2}};
constexpr int kTicksOfSilence = 17;  // after which the peer is lost

// An end that notes what it learns.
struct Listener final : Passenger {
  void boarded(std::uint64_t new_session) override { session = new_session; }
  void arrived(Parcel kind, std::span<const std::byte> contents) override {
    if (kind == Parcel::closed) log += "closed ";
    if (kind == Parcel::frame) numbers.push_back(take_number(contents).value_or(0));
  }
  void line_lost(const Error&) override { log += "lost "; }
  void line_joined(std::uint64_t new_session) override {
    log += "joined ";
    session = new_session;
  }

  std::vector<std::uint64_t> numbers;
  std::string log;
  std::uint64_t session = 0;
};

std::vector<std::byte> numbered(std::uint64_t number) {
  std::vector<std::byte> parcel = begin_parcel(kEdge, Parcel::frame);
  append(parcel, number);
  return parcel;
}

// Two lines and the network between them.
class Pair {
 public:
  explicit Pair(unsigned seed = 1, Duration liveliness = 300ms) : liveliness_(liveliness), random_(seed) {
    restart();
  }

  // Replaces the far process by a new one.
  void restart() {
    restart_without_end();
    far->add(kEdge, far_listener);
  }
  void restart_without_end() {
    far_listener = Listener();
    far_origin_[1] = std::byte{static_cast<unsigned char>(std::to_integer<int>(far_origin_[1]) + 1)};
    far =
        std::make_unique<Line>("near", Line::Settings{kFarId, liveliness_},
                               [this](std::vector<std::byte> bytes, By) { put(to_near_, std::move(bytes)); });
  }

  void put(std::deque<std::vector<std::byte>>& way, std::vector<std::byte> bytes) {
    if (dice() < loss) return;
    if (dice() < doubled) way.push_back(bytes);
    const bool overtakes = dice() < disorder && !way.empty();
    way.insert(overtakes ? way.end() - 1 : way.end(), std::move(bytes));
  }

  void carry() {
    for (int i = 0; i < 1000 && !(to_far_.empty() && to_near_.empty()); ++i) {
      carry_one(to_far_, *far, kNearOrigin);
      carry_one(to_near_, near, far_origin_);
    }
  }

  void tick(int times = 1) {
    for (int i = 0; i < times; ++i) {
      near.tick();
      far->tick();
      carry();
    }
  }

  void drop_all() {
    to_far_.clear();
    to_near_.clear();
  }

  [[nodiscard]] const Origin& far_origin() const { return far_origin_; }
  std::deque<std::vector<std::byte>>& to_near() { return to_near_; }
  std::deque<std::vector<std::byte>>& to_far() { return to_far_; }

  double loss = 0.0, doubled = 0.0, disorder = 0.0;
  Listener near_listener, far_listener;

 private:
  double dice() { return static_cast<double>(random_()) / std::mt19937::max(); }

  static void carry_one(std::deque<std::vector<std::byte>>& way, Line& line, const Origin& from) {
    if (way.empty()) return;
    const std::vector<std::byte> bytes = std::move(way.front());
    way.pop_front();
    std::span<const std::byte> rest = bytes;
    while (const auto message = take_message(rest)) line.receive(*message, from);
  }

  const Duration liveliness_;
  std::mt19937 random_;
  Origin far_origin_{std::byte{1}};
  std::deque<std::vector<std::byte>> to_far_, to_near_;

 public:
  Line near{"far", Line::Settings{1, liveliness_},
            [this](std::vector<std::byte> bytes, By) { put(to_far_, std::move(bytes)); }};
  std::unique_ptr<Line> far;
};

// A pair whose near side has a listener for the edge.
struct ListeningPair : Pair {
  ListeningPair() { near.add(kEdge, near_listener); }
};

std::vector<std::uint64_t> up_to(std::uint64_t last) {
  std::vector<std::uint64_t> numbers;
  for (std::uint64_t i = 1; i <= last; ++i) numbers.push_back(i);
  return numbers;
}

}  // namespace

TEST_CASE("a parcel that was sent before the peer was there arrives", "[patterns][dds]") {
  ListeningPair pair;
  REQUIRE(pair.near.send(numbered(1), pair.near_listener.session) == Sent::yes);
  pair.drop_all();
  CHECK_FALSE(pair.near.is_joined());
  pair.tick(3);
  CHECK(pair.near.is_joined());
  CHECK(pair.far_listener.numbers == up_to(1));
  CHECK(pair.near_listener.log.empty());  // the first time that it joins is no news
}

TEST_CASE("what comes before the end that it is for is there waits for it, in order", "[patterns][dds]") {
  Pair pair;
  pair.restart_without_end();
  pair.near.add(kEdge, pair.near_listener);
  REQUIRE(pair.near.send(numbered(1), pair.near_listener.session) == Sent::yes);
  REQUIRE(pair.near.send(numbered(2), pair.near_listener.session) == Sent::yes);
  pair.tick(3);
  REQUIRE(pair.far->is_joined());
  CHECK(pair.far_listener.numbers.empty());
  pair.far->add(kEdge, pair.far_listener);
  CHECK(pair.far_listener.numbers == up_to(2));
  REQUIRE(pair.near.send(numbered(3), pair.near_listener.session) == Sent::yes);
  pair.carry();
  CHECK(pair.far_listener.numbers == up_to(3));
}

TEST_CASE("what comes for an end that has gone is for nobody, also not for the next one", "[patterns][dds]") {
  ListeningPair pair;
  pair.tick(3);
  pair.far->remove(kEdge);
  REQUIRE(pair.near.send(numbered(1), pair.near_listener.session) == Sent::yes);
  pair.carry();
  pair.far->add(kEdge, pair.far_listener);
  CHECK(pair.far_listener.numbers.empty());
}

TEST_CASE("two lines meet without a tick once DDS has found one of them", "[patterns][dds]") {
  Pair pair;
  pair.near.greet_if_alone();
  pair.carry();
  CHECK(pair.near.is_joined());
  CHECK(pair.far->is_joined());
  pair.near.greet_if_alone();
  CHECK(pair.to_far().empty());  // a peer that is known needs no greeting
}

TEST_CASE("a parcel is written by its sender if the sender asks for it, all else by the outbox",
          "[patterns][dds]") {
  std::vector<By> written;
  std::uint64_t own = 0;
  Line line("far", Line::Settings{1, 300ms}, [&](const std::vector<std::byte>& bytes, By by) {
    std::span<const std::byte> rest = bytes;
    own = take_message(rest)->own;
    written.push_back(by);
  });
  Listener listener;
  line.add(kEdge, listener);
  const std::uint64_t session = listener.session;
  line.greet_if_alone();
  const std::vector<std::byte> reply = encode({kFarId, 5, own, 0, 0, {}});
  std::span<const std::byte> bytes = reply;
  line.receive(*take_message(bytes), Origin{std::byte{2}});
  REQUIRE(line.is_joined());
  CHECK(written == std::vector{By::outbox, By::outbox});
  CHECK(line.send(numbered(1), session, Loss::never, By::caller) == Sent::yes);
  CHECK(line.send(numbered(2), session) == Sent::yes);
  CHECK(written == std::vector{By::outbox, By::outbox, By::caller, By::outbox});
}

TEST_CASE("each parcel arrives once and in order, whatever the network does", "[patterns][dds]") {
  const unsigned seed = GENERATE(1U, 2U, 3U, 4U, 5U, 6U, 7U, 8U);
  CAPTURE(seed);
  Pair pair(seed, 10s);  // nobody is lost for the silence of a bad network
  pair.loss = 0.3;
  pair.doubled = 0.2;
  pair.disorder = 0.3;
  pair.near.add(kEdge, pair.near_listener);
  const std::uint64_t session = pair.near_listener.session;
  constexpr std::uint64_t kCount = 300;
  for (std::uint64_t i = 1; i <= kCount; ++i) {
    REQUIRE(pair.near.send(numbered(i), session) == Sent::yes);
    if (i % 3 == 0) pair.tick();
  }
  pair.tick(200);
  CHECK(pair.far_listener.numbers == up_to(kCount));
  CHECK(pair.near_listener.log.empty());
  CHECK(pair.far_listener.log.empty());
}

TEST_CASE("a peer that was started again is another one", "[patterns][dds]") {
  ListeningPair pair;
  const std::uint64_t session = pair.near_listener.session;
  pair.tick(3);
  pair.loss = 1.0;
  REQUIRE(pair.near.send(numbered(1), session) == Sent::yes);  // the peer never gets it
  pair.loss = 0.0;
  pair.restart();
  pair.tick(kTicksOfSilence + 3);
  CHECK(pair.near_listener.log == "lost joined ");
  CHECK(pair.near.send(numbered(2), session) == Sent::cut);  // it was meant for the old one
  REQUIRE(pair.near.send(numbered(3), pair.near_listener.session) == Sent::yes);
  pair.carry();
  CHECK(pair.far_listener.numbers == std::vector<std::uint64_t>{3});
  CHECK(pair.far_listener.log.empty());
}

TEST_CASE("what a process has said before it was replaced means nothing afterwards", "[patterns][dds]") {
  ListeningPair pair;
  pair.tick(3);
  pair.far->send_now(numbered(1));
  const std::deque<std::vector<std::byte>> late = pair.to_near();
  pair.drop_all();
  pair.restart();
  pair.tick(kTicksOfSilence + 3);
  REQUIRE(pair.near_listener.log == "lost joined ");
  pair.to_near() = late;
  pair.carry();
  pair.tick(3);
  CHECK(pair.near_listener.numbers.empty());
  CHECK(pair.near_listener.log == "lost joined ");
}

TEST_CASE("a stranger who has read along is not believed, whatever of the peer's numbers it says",
          "[patterns][dds]") {
  const std::uint64_t ahead = GENERATE(1U, 2U, 100U);
  const bool is_new = GENERATE(false, true);  // it says that it is a process that was started again
  CAPTURE(ahead, is_new);
  ListeningPair pair;
  pair.tick(3);
  pair.far->send_now(numbered(1));
  std::span<const std::byte> heard = pair.to_near().front();
  Message forged = *take_message(heard);
  const std::vector<std::byte> parcel = numbered(666);
  forged.sequence += is_new ? 0 : ahead;
  forged.own += is_new ? 1 : 0;
  forged.parcel = parcel;
  const Origin stranger{std::byte{9}};
  for (int i = 0; i < 3; ++i) pair.near.receive(forged, stranger);
  pair.carry();
  pair.far->send_now(numbered(2));
  pair.tick(3);
  CHECK(pair.near_listener.numbers == up_to(2));
  CHECK(pair.near_listener.log.empty());
  CHECK(pair.near.is_peer(pair.far_origin()));
  CHECK_FALSE(pair.near.is_peer(stranger));
}

TEST_CASE("a silent peer is lost after the liveliness time, and found again", "[patterns][dds]") {
  ListeningPair pair;
  pair.tick(3);
  pair.loss = 1.0;
  pair.tick(13);  // there may have been silence of up to two ticks before
  CHECK(pair.near_listener.log.empty());
  pair.tick(4);
  CHECK(pair.near_listener.log == "lost ");
  CHECK(pair.far_listener.log == "lost ");
  pair.loss = 0.0;
  pair.tick(3);
  CHECK(pair.near_listener.log == "lost joined ");
  CHECK(pair.far_listener.log == "lost joined ");
}

TEST_CASE("a line that was cut joins again if the peer lives", "[patterns][dds]") {
  ListeningPair pair;
  pair.tick(3);
  pair.near.lose(fail(Code::unavailable, "it is said to be gone"));
  CHECK_FALSE(pair.near.is_peer(pair.far_origin()));
  pair.tick(3);
  CHECK(pair.near_listener.log == "lost joined ");
  CHECK(pair.far_listener.log == "lost joined ");
}

TEST_CASE("an end that is removed tells the other one", "[patterns][dds]") {
  ListeningPair pair;
  pair.tick(3);
  pair.near.remove(kEdge);
  pair.carry();
  CHECK(pair.far_listener.log == "closed ");
}

TEST_CASE("a peer that does not confirm anything is sent no more than fits", "[patterns][dds]") {
  ListeningPair pair;
  const std::uint64_t session = pair.near_listener.session;
  pair.loss = 1.0;
  std::vector<std::byte> large = numbered(1);
  large.resize(std::size_t{3} << 20);
  CHECK(pair.near.send(large, session, Loss::allowed) == Sent::yes);
  CHECK(pair.near.send(large, session, Loss::allowed) == Sent::yes);
  CHECK(pair.near.send(large, session, Loss::allowed) == Sent::no_room);
  CHECK(pair.near.send(numbered(2), session) == Sent::yes);
  large.resize(std::size_t{40} << 20);
  CHECK(pair.near.send(large, session) == Sent::too_large);
}

TEST_CASE("messages that come in one sample are taken one by one, up to one that is cut short",
          "[patterns][dds]") {
  std::vector<std::byte> sample = encode({kFarId, 1, 2, 3, 4, numbered(5)});
  for (const std::vector<std::byte>& more :
       {encode({kFarId, 1, 2, 4, 4, {}}), encode({kFarId, 1, 2, 5, 4, numbered(6)})})
    sample.insert(sample.end(), more.begin(), more.end());
  sample.pop_back();
  std::span<const std::byte> rest = sample;
  const auto first = take_message(rest);
  REQUIRE(first);
  CHECK(first->sequence == 3);
  CHECK(std::ranges::equal(first->parcel, numbered(5)));
  const auto second = take_message(rest);
  REQUIRE(second);
  CHECK(second->sequence == 4);
  CHECK(second->parcel.empty());
  CHECK_FALSE(take_message(rest));
}

TEST_CASE("whatever arrives that is no message is discarded", "[patterns][dds]") {
  ListeningPair pair;
  pair.tick(3);
  std::mt19937 random(5);
  const std::vector<std::byte> good = encode({kFarId, 1, 2, 3, 4, numbered(5)});
  for (int i = 0; i < 2000; ++i) {
    std::vector<std::byte> bad = good;
    bad.resize(random() % (good.size() + 1));
    for (std::byte& byte : bad)
      if (random() % 4 == 0) byte = static_cast<std::byte>(random());
    std::span<const std::byte> rest = bad;
    while (const auto message = take_message(rest)) pair.near.receive(*message, pair.far_origin());
  }
  pair.drop_all();
  CHECK(pair.near_listener.numbers.empty());
  CHECK(pair.near_listener.log.empty());
  pair.far->send_now(numbered(1));
  pair.carry();
  CHECK(pair.near_listener.numbers == up_to(1));
}
