// SPDX-License-Identifier: GPL-3.0-or-later
// The reaction of a byte link's end to a peer that sends invalid data, does not read, or goes away.
#include <catch2/catch.hpp>

#include <array>
#include <string>
#include <vector>

#include "byte_end.hpp"
#include "courier.hpp"
#include "executives.hpp"
#include "frames/push_over_frames.hpp"
#include "frames/request_over_frames.hpp"
#include "orca/base/log.hpp"
#include "orca/idl/motion.hpp"
#include "orca/idl/system.hpp"
#include "orca/patterns/bytes/byte_links.hpp"
#include "peer.hpp"

using namespace orca;
using namespace orca::bytes;
using namespace orca::frames;
using namespace orca::test;
using Catch::Contains;
using idl::MotionCommand;

namespace {

struct Source : Peer {
  explicit Source(Executive& executive) : Peer(executive, "source") {}
  PushServer<MotionCommand> out{*this, "out"};
};

struct Listener : Peer {
  explicit Listener(Executive& executive) : Peer(executive, "listener") {}
  PushProxy<MotionCommand> in{*this, "in"};
};

struct Sender : Peer {
  explicit Sender(Executive& executive) : Peer(executive, "sender") {}
  SendProxy<MotionCommand> out{*this, "out"};
};

struct Taker : Peer {
  explicit Taker(Executive& executive) : Peer(executive, "taker") {}
  Status on_command(const ObjectPtr<MotionCommand>&) { return ok(); }
  SendServer<MotionCommand> in{*this, "in", &Taker::on_command, {.depth = 1}};
};

// Two wires whose other ends the test controls.
class Wires {
 public:
  explicit Wires(Executive& executive, std::size_t capacity = 4096)
      : executive_(executive), capacity_(capacity) {
    log::set_level(log::Level::error);  // being cut off is a warning
    courier_.serve(to_peer_);
    courier_.serve(from_peer_);
  }
  ~Wires() { log::set_level(log::Level::info); }
  Wires(const Wires&) = delete;
  Wires& operator=(const Wires&) = delete;

  std::unique_ptr<ByteEnd> end() {
    return std::make_unique<ByteEnd>(Connection{executive_, traffic_, "a to b", to_peer_, from_peer_});
  }

  void say(std::span<const std::byte> bytes) { CHECK(from_peer_->write(bytes) == bytes.size()); }
  void say(const Frame& frame) { say(in_stream(frame)); }
  void hang_up() { from_peer_->close(); }

  [[nodiscard]] bool cuts_off() {
    return eventually(executive_, [&] { return traffic_.peers_cut_off == 1; });
  }
  [[nodiscard]] std::uint64_t frames_received() const { return traffic_.frames_received; }

  /// Waits for that many frames to the peer and returns their kinds.
  [[nodiscard]] std::vector<FrameKind> kinds_sent(std::size_t count) {
    std::vector<FrameKind> kinds;
    FrameSplitter splitter;
    const auto have_come = [&] {
      std::array<std::byte, 4096> portion;
      splitter.append(std::span(portion).first(to_peer_->read(portion)));
      while (const auto frame = *splitter.next()) kinds.push_back(FrameReader(*frame).kind());
      return kinds.size() >= count;
    };
    CHECK(eventually(executive_, have_come));
    return kinds;
  }

 private:
  Executive& executive_;
  const std::size_t capacity_;
  Courier courier_;
  Traffic traffic_;
  std::shared_ptr<ByteWire> to_peer_ = std::make_shared<ByteWire>(courier_, capacity_);
  std::shared_ptr<ByteWire> from_peer_ = std::make_shared<ByteWire>(courier_, capacity_);
};

std::vector<std::byte> rubbish() { return std::vector<std::byte>(100, std::byte{0xee}); }

Frame attach_frame(std::uint64_t interval_ns = 0, std::uint64_t multiple = 1) {
  Frame frame(FrameKind::attach, 1);
  frame.add(interval_ns);
  frame.add(multiple);
  return frame;
}

}  // namespace

TEST_CASE("a subscriber that sends rubbish is cut off, counted, and costs the publisher nothing",
          "[patterns][bytes]") {
  run_on_each(steady_executives(), [](Executive& executive) {
    Wires wires(executive);
    Source source(executive);
    auto& server = static_cast<PushServerEndpoint&>(source.endpoint("out"));
    server.adopt(std::make_unique<PushSinkOverFrames>(
        wires.end(), server.connect(),
        QueuePolicy{.overflow = QueuePolicy::Overflow::block, .block_limit = 1h}));
    wires.say(attach_frame());
    REQUIRE(eventually(executive, [&] { return source.out.subscriber_count() == 1; }));
    wires.say(rubbish());
    REQUIRE(wires.cuts_off());
    CHECK(eventually(executive, [&] { return source.out.subscriber_count() == 0; }));
    source.out.push(full_stop());  // does not wait
  });
}

TEST_CASE("a peer that reads nothing is cut off as soon as too much waits for it, even if that is one frame",
          "[patterns][bytes]") {
  run_on_each(steady_executives(), [](Executive& executive) {
    Wires wires(executive);
    const auto end = wires.end();
    end->start({[](FrameReader&) { return ok(); }, [](const Error&) {}, [] {}});
    Frame frame(FrameKind::offer, 1);
    frame.add(std::string(std::size_t{65} << 20, 'x'));
    CHECK(end->send(frame) == Sent::yes);
    CHECK(wires.cuts_off());
  });
}

TEST_CASE("an end whose link is cut sends nothing more, and says so", "[patterns][bytes]") {
  run_on_each(steady_executives(), [](Executive& executive) {
    Wires wires(executive);
    const auto end = wires.end();
    end->start({[](FrameReader&) { return ok(); }, [](const Error&) {}, [] {}});
    CHECK(end->send(Frame(FrameKind::detach, 1)) == Sent::yes);
    wires.hang_up();
    REQUIRE(eventually(executive, [&] { return end->is_cut(); }));
    CHECK(end->send(Frame(FrameKind::detach, 1)) == Sent::cut);
    CHECK(end->send(Frame(FrameKind::object, 1), Loss::allowed) == Sent::cut);
  });
}

TEST_CASE("while nothing is lost each object is one frame", "[patterns][bytes]") {
  run_on_each(steady_executives(), [](Executive& executive) {
    Wires wires(executive);
    Source source(executive);
    auto& server = static_cast<PushServerEndpoint&>(source.endpoint("out"));
    server.adopt(std::make_unique<PushSinkOverFrames>(wires.end(), server.connect(), QueuePolicy{}));
    wires.say(attach_frame());
    REQUIRE(eventually(executive, [&] { return source.out.subscriber_count() == 1; }));
    for (int i = 0; i < 3; ++i) source.out.push(full_stop());
    CHECK(wires.kinds_sent(4) ==
          std::vector{FrameKind::granted, FrameKind::object, FrameKind::object, FrameKind::object});
  });
}

TEST_CASE("a subscriber that asks for an impossible rate is cut off before anybody acts on it",
          "[patterns][bytes]") {
  constexpr std::uint64_t kNegative = ~std::uint64_t{0};  // as an interval: -1 ns
  struct Asked {
    std::uint64_t interval_ns;
    std::uint64_t multiple;
  };
  const Asked asked = GENERATE(Asked{kNegative, 1}, Asked{0, 0}, Asked{0, std::uint64_t{1} << 32});
  run_on_each(steady_executives(), [&](Executive& executive) {
    Wires wires(executive);
    Source source(executive);
    auto& server = static_cast<PushServerEndpoint&>(source.endpoint("out"));
    server.adopt(std::make_unique<PushSinkOverFrames>(wires.end(), server.connect(), QueuePolicy{}));
    wires.say(attach_frame(asked.interval_ns, asked.multiple));
    REQUIRE(wires.cuts_off());
    CHECK(source.out.subscriber_count() == 0);
  });
}

TEST_CASE("a subscriber may ask for the slowest rate that can be said", "[patterns][bytes]") {
  run_on_each(steady_executives(), [](Executive& executive) {
    Wires wires(executive);
    Source source(executive);
    auto& server = static_cast<PushServerEndpoint&>(source.endpoint("out"));
    server.adopt(std::make_unique<PushSinkOverFrames>(wires.end(), server.connect(), QueuePolicy{}));
    wires.say(
        attach_frame(static_cast<std::uint64_t>(Duration::max().count()), (std::uint64_t{1} << 32) - 1));
    CHECK(eventually(executive, [&] { return source.out.subscriber_count() == 1; }));
  });
}

TEST_CASE("a subscriber that attaches a second time is still one subscriber", "[patterns][bytes]") {
  run_on_each(steady_executives(), [](Executive& executive) {
    Wires wires(executive);
    Source source(executive);
    auto& server = static_cast<PushServerEndpoint&>(source.endpoint("out"));
    server.adopt(std::make_unique<PushSinkOverFrames>(wires.end(), server.connect(), QueuePolicy{}));
    wires.say(attach_frame());
    wires.say(attach_frame());
    CHECK(wires.kinds_sent(2) == std::vector{FrameKind::granted, FrameKind::granted});
    CHECK(source.out.subscriber_count() == 1);
    source.out.push(full_stop());
    source.out.start(50ms);
    CHECK(wires.kinds_sent(2) == std::vector{FrameKind::object, FrameKind::granted});
  });
}

TEST_CASE(
    "a publisher that sends an object that cannot be decoded is cut off, and the subscriber keeps its "
    "objects",
    "[patterns][bytes]") {
  run_on_each(steady_executives(), [](Executive& executive) {
    Wires wires(executive);
    Listener listener(executive);
    auto& client = static_cast<PushClientEndpoint&>(listener.endpoint("in"));
    auto end = std::make_unique<PushSourceOverFrames>(wires.end(), object_type<MotionCommand>(), "source.out",
                                                      Duration{0});
    client.connect(*end, {.depth = 4});
    client.adopt(std::move(end));
    listener.in.subscribe();
    Frame good(FrameKind::object, 1);
    good.add(std::uint64_t{0});
    good.add(ObjectRef(head(0.0, 3.0).seal()));
    wires.say(good);
    REQUIRE(listener.in.get_update_wait_max(5s));
    Frame bad(FrameKind::object, 1);
    bad.add(std::uint64_t{0});
    bad.add(std::string("no motion command"));
    wires.say(bad);
    REQUIRE(wires.cuts_off());
    CHECK_FALSE(listener.in.new_data_arrived());
    CHECK(listener.in.latest()->speed() == 3.0);
  });
}

TEST_CASE("a frame that does not belong to the pattern cuts its sender off", "[patterns][bytes]") {
  run_on_each(steady_executives(), [](Executive& executive) {
    Wires wires(executive);
    Taker taker(executive);
    auto& server = static_cast<SendServerEndpoint&>(taker.endpoint("in"));
    server.adopt(std::make_unique<CallerOverFrames<Status>>(
        wires.end(), RequestTypes{object_type<MotionCommand>(), nullptr}, server.connect("a.out", {})));
    wires.say(attach_frame());
    REQUIRE(wires.cuts_off());
    CHECK(wires.frames_received() == 1);
  });
}

TEST_CASE("a sender whose link is cut gets an error, at once and from then on", "[patterns][bytes]") {
  run_on_each(steady_executives(), [](Executive& executive) {
    const bool rubbish_first = GENERATE(true, false);
    Wires wires(executive);
    Sender sender(executive);
    auto& client = static_cast<SendClientEndpoint&>(sender.endpoint("out"));
    auto end = std::make_unique<TargetOverFrames<Status>>(wires.end(), sender.strand(),
                                                          RequestTypes{object_type<MotionCommand>(), nullptr},
                                                          "taker.in", Duration{0});
    client.connect(*end);
    client.adopt(std::move(end));
    const Result<SendId> id = sender.out.send_request(full_stop());
    REQUIRE(id.has_value());
    rubbish_first ? wires.say(rubbish()) : wires.hang_up();
    for (const Status& refused : {sender.out.send_receive_wait(*id, 5s), sender.out.send(full_stop())}) {
      REQUIRE_FALSE(refused.ok());
      CHECK(refused.error().code == Code::unavailable);
      CHECK_THAT(refused.error().text(), Contains("taker.in cannot be reached: the link was cut"));
    }
  });
}

TEST_CASE("objects for which a link has no room are counted at the subscriber", "[patterns][bytes]") {
  run_on_each(steady_executives(), [](Executive& executive) {
    ByteLinks links(executive, 256);
    Source source(executive);
    Listener listener(executive);
    constexpr std::size_t kRoom = 20'000;  // at the subscriber, which loses none itself
    REQUIRE(links.connect(source.endpoint("out"), listener.endpoint("in"), {.depth = kRoom}).ok());
    listener.in.subscribe();
    REQUIRE(eventually(executive, [&] { return source.out.subscriber_count() == 1; }));
    // The thread that hands over keeps up for a while, if it has a processor of its own.
    for (std::size_t i = 0; i < kRoom / 2 && (i < 500 || links.counters().objects_lost == 0); ++i)
      source.out.push(full_stop());
    CHECK(links.counters().objects_lost > 0);
    CHECK(eventually(executive, [&] {
      source.out.push(full_stop());  // losses are reported with the next object for which there is room
      sleep(executive, 1ms);
      return listener.in.counters().dropped_by_link == links.counters().objects_lost;
    }));
    CHECK(listener.in.counters().dropped == links.counters().objects_lost);
    CHECK(links.counters().peers_cut_off == 0);
  });
}

TEST_CASE("an object larger than the link's queues still arrives", "[patterns][bytes]") {
  run_on_each(steady_executives(), [](Executive& executive) {
    ByteLinks links(executive, 64);
    struct Out : Peer {
      using Peer::Peer;
      PushServer<idl::ClientList> out{*this, "out"};
    };
    struct In : Peer {
      using Peer::Peer;
      PushProxy<idl::ClientList> in{*this, "in"};
    };
    Out out(executive, "out");
    In in(executive, "in");
    REQUIRE(links.connect(out.endpoint("out"), in.endpoint("in")).ok());
    in.in.subscribe();
    REQUIRE(eventually(executive, [&] { return out.out.subscriber_count() == 1; }));
    auto list = out.out.loan();
    list->clients() = {std::string(10'000, 'x'), "y"};
    out.out.push(std::move(list));
    const auto got = in.in.get_update_wait_max(5s);
    REQUIRE(got);
    CHECK(got->clients() == std::vector<std::string>{std::string(10'000, 'x'), "y"});
  });
}

TEST_CASE("a publisher notices that its subscriber's end has gone", "[patterns][bytes]") {
  run_on_each(steady_executives(), [](Executive& executive) {
    ByteLinks links(executive, 4096);
    Source source(executive);
    {
      Listener listener(executive);
      REQUIRE(links.connect(source.endpoint("out"), listener.endpoint("in")).ok());
      listener.in.subscribe();
      REQUIRE(eventually(executive, [&] { return source.out.subscriber_count() == 1; }));
    }
    CHECK(eventually(executive, [&] { return source.out.subscriber_count() == 0; }));
    source.out.push(full_stop());
    CHECK(links.counters().peers_cut_off == 0);
  });
}
