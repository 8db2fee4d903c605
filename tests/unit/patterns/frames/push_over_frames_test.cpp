// SPDX-License-Identifier: GPL-3.0-or-later
// The two ends of a Push edge between processes, each with a peer that the test plays.
#include "frames/push_over_frames.hpp"

#include <catch2/catch.hpp>

#include "executives.hpp"
#include "orca/idl/motion.hpp"
#include "orca/idl/navigation.hpp"
#include "peer.hpp"
#include "played_end.hpp"

using namespace orca;
using namespace orca::frames;
using namespace orca::test;
using Catch::Contains;
using Kinds = std::vector<FrameKind>;

namespace {

ObjectRef some_object() { return ObjectRef(head(0.5, 2.0).seal()); }

// What a subscriber may ask for at the most.
constexpr auto kSlowest = static_cast<std::uint64_t>(Duration::max().count());  // [ns]
constexpr std::uint32_t kMostMultiple = ~std::uint32_t{0};

std::vector<std::uint64_t> numbers_of(const Frame& frame, int count) {
  std::vector<std::byte> bytes;
  frame.append_to(bytes);
  FrameReader reader(bytes);
  std::vector<std::uint64_t> numbers;
  for (int i = 0; i < count; ++i) numbers.push_back(reader.read_number());
  return numbers;
}

Frame with_object(std::uint64_t subscription, std::uint64_t ticket) {
  Frame frame = frame_of(FrameKind::object, subscription, {ticket});
  frame.add(some_object());
  return frame;
}

// The client's queue, as the link sees it.
struct Sink final : PushSink {
  std::optional<Duration> deliver(ObjectRef&& object) override {
    if (is_full) return 2s;
    taken.push_back(std::move(object));
    return std::nullopt;
  }
  void give_up(const ObjectRef& object) override { given_up += object ? 1 : 100; }
  void granted(const UpdateGrant& grant) override { grants.push_back(grant); }
  void lost(std::uint64_t objects) override { losses += objects; }

  bool is_full = false;
  std::vector<ObjectRef> taken;
  int given_up = 0;
  std::uint64_t losses = 0;
  std::vector<UpdateGrant> grants;
};

// The server's port, as the link sees it.
struct Source final : PushSource {
  void attach(PushSink& /*sink*/, const UpdateRate& rate) override {
    ++attached;
    rates.push_back(rate);
  }
  void detach() override { ++detached; }
  void change(const UpdateRate& rate) override { rates.push_back(rate); }
  void room() override { ++rooms; }
  [[nodiscard]] Duration base_period() const override { return 0s; }
  [[nodiscard]] std::string path() const override { return "a.out"; }

  int attached = 0, detached = 0, rooms = 0;
  std::vector<UpdateRate> rates;
};

struct Client {
  Played peer;
  Sink sink;
  PushSourceOverFrames source{std::make_unique<PlayedEnd>(peer), object_type<idl::MotionCommand>(), "a.out",
                              40ms};
};

struct Server {
  explicit Server(QueuePolicy::Overflow overflow = QueuePolicy::Overflow::drop_oldest)
      : sink(std::make_unique<PlayedEnd>(peer), source, {.overflow = overflow, .block_limit = 3s}) {}
  std::optional<Duration> push(const ObjectRef& object) {
    ObjectRef copy = object;
    return sink.deliver(std::move(copy));
  }
  Played peer;
  Source source;
  PushSinkOverFrames sink;
};

}  // namespace

TEST_CASE(
    "a client tells its server what it asks for, and a rate that makes no sense as the nearest that does",
    "[patterns][frames]") {
  Client client;
  client.source.attach(client.sink, {30ms, 2});
  client.source.change({-1s, 0});
  client.source.detach();
  REQUIRE(client.peer.sent.size() == 3);
  CHECK(client.peer.sent[0].kind() == FrameKind::attach);
  CHECK(numbers_of(client.peer.sent[0], 2) == std::vector<std::uint64_t>{30'000'000, 2});
  CHECK(client.peer.sent[1].kind() == FrameKind::change);
  CHECK(numbers_of(client.peer.sent[1], 2) == std::vector<std::uint64_t>{0, 1});
  CHECK(client.peer.sent[2].kind() == FrameKind::detach);
  for (const Frame& frame : client.peer.sent) CHECK(frame.number() == 1);
  client.source.attach(client.sink, {});
  CHECK(client.peer.sent[3].number() == 2);  // another subscription
  CHECK(client.source.path() == "a.out");
}

TEST_CASE("an object of another subscription, or of none, is not delivered", "[patterns][frames]") {
  Client client;
  CHECK(client.peer.say(with_object(0, 0)).ok());
  client.source.attach(client.sink, {});
  CHECK(client.peer.say(with_object(1, 0)).ok());
  CHECK(client.peer.say(with_object(2, 0)).ok());
  CHECK(client.sink.taken.size() == 1);
  client.source.detach();
  CHECK(client.peer.say(with_object(1, 0)).ok());
  CHECK(client.sink.taken.size() == 1);
}

TEST_CASE("an object that its publisher waits for is confirmed when it is taken, any other is not",
          "[patterns][frames]") {
  Client client;
  client.source.attach(client.sink, {});
  (void)client.peer.kinds();
  CHECK(client.peer.say(with_object(1, 0)).ok());
  CHECK(client.peer.sent.empty());
  CHECK(client.peer.say(with_object(1, 9)).ok());
  REQUIRE(client.peer.sent.size() == 1);
  CHECK(client.peer.sent[0].kind() == FrameKind::taken);
  CHECK(client.peer.sent[0].number() == 1);
  CHECK(client.peer.sent[0].first_number() == 9);
}

TEST_CASE("an object that finds no room waits until there is some, and is then confirmed",
          "[patterns][frames]") {
  Client client;
  client.source.attach(client.sink, {});
  (void)client.peer.kinds();
  client.source.room();  // nothing waits for it
  client.sink.is_full = true;
  CHECK(client.peer.say(with_object(1, 9)).ok());
  client.source.room();  // too early
  CHECK(client.peer.sent.empty());
  client.sink.is_full = false;
  client.source.room();
  CHECK(client.sink.taken.size() == 1);
  CHECK(client.peer.kinds() == Kinds{FrameKind::taken});
  client.source.room();
  CHECK(client.sink.taken.size() == 1);
}

TEST_CASE("an object that waits for room is given up when its publisher says so, or is gone",
          "[patterns][frames]") {
  Client client;
  client.source.attach(client.sink, {});
  client.sink.is_full = true;
  CHECK(client.peer.say(with_object(1, 9)).ok());
  CHECK(client.peer.say(frame_of(FrameKind::give_up, 1, {8})).ok());  // of another object
  CHECK(client.peer.say(frame_of(FrameKind::give_up, 2, {9})).ok());  // of another subscription
  CHECK(client.sink.given_up == 0);
  CHECK(client.peer.say(frame_of(FrameKind::give_up, 1, {9})).ok());
  CHECK(client.sink.given_up == 1);
  CHECK(client.peer.say(frame_of(FrameKind::give_up, 1, {9})).ok());
  client.peer.handlers.cut(fail(Code::unavailable, "gone"));
  CHECK(client.sink.given_up == 1);  // none waits
  CHECK(client.peer.say(with_object(1, 10)).ok());
  client.peer.handlers.cut(fail(Code::unavailable, "gone"));
  CHECK(client.sink.given_up == 2);
}

TEST_CASE("an object that waits for room is forgotten when its subscription ends", "[patterns][frames]") {
  Client client;
  client.source.attach(client.sink, {});
  client.sink.is_full = true;
  CHECK(client.peer.say(with_object(1, 9)).ok());
  client.source.detach();
  client.source.room();
  client.peer.handlers.cut(fail(Code::unavailable, "gone"));
  CHECK(client.sink.given_up == 0);
  CHECK(client.sink.taken.empty());
}

TEST_CASE("a subscriber is subscribed again at a server that was started again, and only a subscriber",
          "[patterns][frames]") {
  Client client;
  client.peer.handlers.renewed();
  CHECK(client.peer.sent.empty());
  client.source.attach(client.sink, {30ms, 2});
  client.peer.handlers.renewed();
  CHECK(numbers_of(client.peer.sent.at(1), 2) == std::vector<std::uint64_t>{30'000'000, 2});
  CHECK(client.peer.sent[1].number() == 2);
  CHECK(client.peer.kinds() == Kinds{FrameKind::attach, FrameKind::attach});
}

TEST_CASE("what the server grants and loses reaches the subscriber", "[patterns][frames]") {
  Client client;
  CHECK(client.source.base_period() == 40ms);
  client.source.attach(client.sink, {});
  CHECK(client.peer.say(frame_of(FrameKind::granted, 1, {20'000'000, 3, 60'000'000})).ok());
  CHECK(client.peer.say(frame_of(FrameKind::granted, 2, {10'000'000, 1, 10'000'000})).ok());
  CHECK(client.sink.grants == std::vector<UpdateGrant>{{20ms, 3, 60ms}});
  CHECK(client.source.base_period() == 20ms);
  CHECK(client.peer.say(frame_of(FrameKind::lost, 1, {5})).ok());
  CHECK(client.peer.say(frame_of(FrameKind::lost, 2, {7})).ok());
  CHECK(client.sink.losses == 5);
}

TEST_CASE("a client refuses what a server of Push cannot say", "[patterns][frames]") {
  Client client;
  client.source.attach(client.sink, {});
  constexpr std::uint64_t kTooLong = std::uint64_t{1} << 63;
  for (const Frame& frame :
       {frame_of(FrameKind::attach, 1, {0, 1}), frame_of(FrameKind::taken, 1, {1}),
        frame_of(FrameKind::answer, 1), frame_of(FrameKind::granted, 1, {kTooLong, 1, 0}),
        frame_of(FrameKind::granted, 1, {0, 0, 0}), frame_of(FrameKind::granted, 1, {0, 1, kTooLong}),
        frame_of(FrameKind::granted, 1, {0, 1}),
        frame_of(FrameKind::granted, 1, {0, std::uint64_t{1} << 32, 0}), frame_of(FrameKind::lost, 1),
        frame_of(FrameKind::lost, 1, {1, 2}), frame_of(FrameKind::give_up, 1),
        frame_of(FrameKind::object, 1, {0})}) {
    CAPTURE(static_cast<int>(frame.kind()));
    CHECK_FALSE(client.peer.say(frame).ok());
  }
  CHECK_THAT(client.peer.say(frame_of(FrameKind::answer, 1)).error().message, Contains("Push"));
  CHECK_THAT(client.peer.say(frame_of(FrameKind::granted, 1, {0, 0, 0})).error().message,
             Contains("a frame of kind 4 says 0 where at least 1 and at most 4294967295 is possible"));
  Frame other = frame_of(FrameKind::object, 1, {0});
  other.add(ObjectRef(make_object<idl::GoalPoint>().seal()));
  CHECK_FALSE(client.peer.say(other).ok());
  CHECK(client.sink.grants.empty());
  CHECK(client.sink.losses == 0);
  CHECK(client.sink.taken.empty());
}

TEST_CASE("a server attaches, changes and detaches a subscriber as its client asks", "[patterns][frames]") {
  Server server;
  CHECK(server.peer.say(frame_of(FrameKind::attach, 4, {30, 2})).ok());
  CHECK(server.peer.say(frame_of(FrameKind::change, 4, {50, 3})).ok());
  CHECK(server.source.rates == std::vector<UpdateRate>{{30ns, 2}, {50ns, 3}});
  CHECK(server.source.attached == 1);
  CHECK(server.source.detached == 0);
  CHECK(server.peer.say(frame_of(FrameKind::detach, 4)).ok());
  CHECK(server.source.detached == 1);
  server.peer.handlers.cut(fail(Code::unavailable, "gone"));
  CHECK(server.source.detached == 2);
}

TEST_CASE("a server refuses what a client of Push cannot say", "[patterns][frames]") {
  Server server;
  for (const Frame& frame : {frame_of(FrameKind::granted, 1, {0, 1, 0}), frame_of(FrameKind::offer, 1),
                             frame_of(FrameKind::lost, 1, {1}), frame_of(FrameKind::attach, 1, {0, 0}),
                             frame_of(FrameKind::attach, 1, {kSlowest + 1, 1}),
                             frame_of(FrameKind::attach, 1, {0, std::uint64_t{kMostMultiple} + 1}),
                             frame_of(FrameKind::change, 1, {0}), frame_of(FrameKind::taken, 1)}) {
    CAPTURE(static_cast<int>(frame.kind()));
    CHECK_FALSE(server.peer.say(frame).ok());
  }
  CHECK_THAT(server.peer.say(frame_of(FrameKind::offer, 1)).error().message, Contains("Push"));
  CHECK(server.source.rates.empty());
  CHECK(server.peer.say(frame_of(FrameKind::attach, 1, {kSlowest, kMostMultiple})).ok());
  CHECK(server.source.rates == std::vector<UpdateRate>{{Duration::max(), kMostMultiple}});
}

TEST_CASE("a subscriber that attaches a second time is still one, and none once it is cut off",
          "[patterns][frames]") {
  run_on({}, [](Executive& executive) {
    Played peer;
    Peer publisher(executive, "publisher");
    PushServer<idl::MotionCommand> out(publisher, "out");
    auto& port = static_cast<PushServerEndpoint&>(publisher.endpoint("out"));
    port.adopt(std::make_unique<PushSinkOverFrames>(std::make_unique<PlayedEnd>(peer), port.connect(),
                                                    QueuePolicy{}));
    for (const std::uint64_t subscription : {1U, 2U})
      CHECK(peer.say(frame_of(FrameKind::attach, subscription, {0, 1})).ok());
    CHECK(out.subscriber_count() == 1);
    out.push(full_stop());
    out.start(50ms);
    CHECK(peer.kinds() ==
          Kinds{FrameKind::granted, FrameKind::granted, FrameKind::object, FrameKind::granted});
    peer.handlers.cut(fail(Code::data_loss, "it sent rubbish"));
    CHECK(out.subscriber_count() == 0);
    out.push(full_stop());
    CHECK(peer.sent.empty());
  });
}

TEST_CASE(
    "objects that may be dropped go without a ticket, and lost ones are reported with the next that goes",
    "[patterns][frames]") {
  Server server;
  REQUIRE(server.peer.say(frame_of(FrameKind::attach, 4, {0, 1})).ok());
  CHECK_FALSE(server.push(some_object()));
  REQUIRE(server.peer.sent.size() == 1);
  CHECK(server.peer.sent[0].kind() == FrameKind::object);
  CHECK(server.peer.sent[0].number() == 4);
  CHECK(server.peer.sent[0].first_number() == 0);
  CHECK(server.peer.losses[0] == Loss::allowed);
  (void)server.peer.kinds();
  for (const Sent trouble : {Sent::no_room, Sent::too_large}) {
    server.peer.outcome = trouble;
    CHECK_FALSE(server.push(some_object()));
  }
  server.sink.lost(3);
  CHECK(server.peer.traffic.objects_lost == 5);
  server.peer.outcome = Sent::yes;
  CHECK_FALSE(server.push(some_object()));
  REQUIRE(server.peer.sent.size() == 2);
  CHECK(server.peer.sent[0].kind() == FrameKind::lost);
  CHECK(server.peer.sent[0].first_number() == 5);
  CHECK(server.peer.sent[1].kind() == FrameKind::object);
  (void)server.peer.kinds();
  CHECK_FALSE(server.push(some_object()));
  CHECK(server.peer.kinds() == Kinds{FrameKind::object});  // reported once
}

TEST_CASE("a publisher that may wait does so until the client has taken the object", "[patterns][frames]") {
  Server server(QueuePolicy::Overflow::block);
  REQUIRE(server.peer.say(frame_of(FrameKind::attach, 4, {0, 1})).ok());
  const ObjectRef first = some_object();
  CHECK(server.push(first) == Duration{3s});
  CHECK(server.push(first) == Duration{3s});  // asks again, which sends nothing
  REQUIRE(server.peer.sent.size() == 1);
  CHECK(server.peer.sent[0].first_number() == 1);
  CHECK(server.peer.losses[0] == Loss::never);
  CHECK(server.peer.say(frame_of(FrameKind::taken, 4, {2})).ok());  // of another object
  CHECK(server.push(first) == Duration{3s});
  CHECK(server.peer.say(frame_of(FrameKind::taken, 4, {1})).ok());
  CHECK(server.peer.say(frame_of(FrameKind::taken, 4, {2})).ok());
  CHECK(server.source.rooms == 3);
  CHECK_FALSE(server.push(first));
  CHECK(server.push(some_object()) == Duration{3s});
  CHECK(server.peer.sent.at(1).first_number() == 2);
}

TEST_CASE("a publisher that has waited long enough gives up, and its client learns which object",
          "[patterns][frames]") {
  Server server(QueuePolicy::Overflow::block);
  REQUIRE(server.peer.say(frame_of(FrameKind::attach, 4, {0, 1})).ok());
  const ObjectRef object = some_object();
  CHECK(server.push(object) == Duration{3s});
  server.sink.give_up(object);
  REQUIRE(server.peer.sent.size() == 2);
  CHECK(server.peer.sent[1].kind() == FrameKind::give_up);
  CHECK(server.peer.sent[1].number() == 4);
  CHECK(server.peer.sent[1].first_number() == 1);
  CHECK(server.push(object) == Duration{3s});  // pushed anew, it is another one
  CHECK(server.peer.sent.size() == 3);
}

TEST_CASE("a publisher waits neither for an object that cannot be sent nor for a client that is gone",
          "[patterns][frames]") {
  Server server(QueuePolicy::Overflow::block);
  REQUIRE(server.peer.say(frame_of(FrameKind::attach, 4, {0, 1})).ok());
  const ObjectRef object = some_object();
  server.peer.outcome = Sent::too_large;
  CHECK_FALSE(server.push(object));
  CHECK(server.peer.traffic.objects_lost == 1);
  server.peer.outcome = Sent::yes;
  CHECK(server.push(object) == Duration{3s});
  server.peer.handlers.cut(fail(Code::unavailable, "gone"));
  server.peer.is_cut = true;
  CHECK_FALSE(server.push(object));
  server.peer.is_cut = false;  // the next client
  (void)server.peer.kinds();
  CHECK(server.push(object) == Duration{3s});
  CHECK(server.peer.kinds() == Kinds{FrameKind::object});
}

TEST_CASE("a server tells its client the rate that it grants", "[patterns][frames]") {
  Server server;
  REQUIRE(server.peer.say(frame_of(FrameKind::attach, 4, {0, 1})).ok());
  server.sink.granted({20ms, 3, 60ms});
  REQUIRE(server.peer.sent.size() == 1);
  CHECK(server.peer.sent[0].kind() == FrameKind::granted);
  CHECK(server.peer.sent[0].number() == 4);
  CHECK(numbers_of(server.peer.sent[0], 3) == std::vector<std::uint64_t>{20'000'000, 3, 60'000'000});
}
