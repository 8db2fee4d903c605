// SPDX-License-Identifier: GPL-3.0-or-later
// How the objects of a Push edge move from the line to the topic, and what becomes of those on their way meanwhile.
#include <catch2/catch.hpp>

#include "case_in.hpp"
#include "executives.hpp"
#include "orca/base/log.hpp"
#include "orca/idl/motion.hpp"
#include "orca/idl/system.hpp"
#include "played_peer.hpp"

using namespace orca;
using namespace orca::dds;
using namespace orca::test;
using frames::Frame;
using frames::FrameKind;
using frames::FrameReader;
using frames::Loss;
using frames::Sent;
using Numbers = std::vector<std::uint64_t>;
using Kinds = std::vector<Parcel>;

namespace {

constexpr std::size_t kMebibyte = std::size_t{1} << 20;
constexpr std::size_t kLarge = 3 * kMebibyte / 2;  // two of them may wait, three are too much
constexpr std::uint64_t kBit = 4;
constexpr std::uint64_t kSubscription = 3;

ObjectRef drive_ahead() { return ObjectRef(head(0.0, 1.0).seal()); }

Frame object_frame(const ObjectRef& object, std::uint64_t subscription = kSubscription,
                   std::uint64_t ticket = 0) {
  Frame frame(FrameKind::object, subscription);
  frame.add(ticket);
  frame.add(object);
  return frame;
}

Kinds kinds_of(const std::vector<PlayedPeer::Said>& said) {
  Kinds kinds;
  for (const PlayedPeer::Said& one : said) kinds.push_back(one.kind);
  return kinds;
}

Numbers numbers_in(std::span<const std::byte> contents) {
  Numbers numbers;
  while (const auto number = take_number(contents)) numbers.push_back(*number);
  return numbers;
}

// What the strand of an end has been told.
struct Told {
  frames::FrameHandlers handlers() {
    return {[this](FrameReader& frame) {
              kinds.push_back(frame.kind());
              numbers.push_back(frame.number());
              if (frame.kind() == FrameKind::lost) lost += frame.read_number();
              if (frame.kind() == FrameKind::object) {
                CHECK(frame.read_number() == 0);  // nobody waits for it
                CHECK(frame.read_object(object_type<idl::Ask>()));
              }
              if (frame.kind() == FrameKind::granted)
                for (int i = 0; i < 3; ++i) (void)frame.read_number();
              return ok();
            },
            [this](const Error& reason) { why_cut = reason.message; }, [this] { ++renewals; }};
  }
  [[nodiscard]] std::size_t objects() const {
    return static_cast<std::size_t>(std::ranges::count(kinds, FrameKind::object));
  }

  std::vector<FrameKind> kinds;
  Numbers numbers;
  std::uint64_t lost = 0;
  std::string why_cut;
  int renewals = 0;
};

// Runs the body as a task, with warnings left out of the log: being cut off is one.
void with_peer(const std::function<void(PlayedPeer&)>& body) {
  log::set_level(log::Level::error);
  run_on({}, [&](Executive& executive) {
    PlayedPeer peer(executive);
    body(peer);
  });
  log::set_level(log::Level::info);
}

// The server's end of an edge, its client having been met.
struct Publisher {
  explicit Publisher(PlayedPeer& to) : peer(to) {
    end.start(told.handlers());
    peer.meet();
  }
  Sent push(const ObjectRef& object, std::uint64_t subscription = kSubscription, std::uint64_t ticket = 0) {
    return end.send(object_frame(object, subscription, ticket), Loss::allowed);
  }

  PlayedPeer& peer;
  const std::shared_ptr<NotedTopic> topic = std::make_shared<NotedTopic>();
  const std::shared_ptr<Publication> publication = std::make_shared<Publication>(peer.outbox(), topic);
  Told told;
  PublishingEnd end{peer.place(), publication, kBit};
};

// The client's end of an edge, its server having been met.
struct Reader {
  explicit Reader(PlayedPeer& from) : peer(from) {
    end.start(told.handlers());
    peer.meet();
  }
  ~Reader() { end.stop(); }
  Reader(const Reader&) = delete;
  Reader& operator=(const Reader&) = delete;

  // Lets the topic bring an object.
  // @param size  of its text [bytes].
  void come(std::uint64_t edges, std::uint32_t epoch, std::uint64_t missed = 0, std::size_t size = 1,
            const Origin& origin = kPeerOrigin) {
    auto ask = make_object<idl::Ask>();
    ask->about() = std::string(size, 'x');
    const ObjectRef object(std::move(ask).seal());
    std::vector<std::byte> bytes(kHeadroom + object.type().write(object.get(), {}));
    (void)object.type().write(object.get(), std::span(bytes).subspan(kHeadroom));
    end.take_sample({std::move(bytes), {object.type().layout_hash, edges, epoch}, origin, 1}, missed);
  }
  void go_direct(std::uint32_t epoch = 2) { peer.say(Parcel::direct, {kSubscription, kBit, epoch}); }
  void take_in() { peer.strand().take_in(); }

  PlayedPeer& peer;
  Told told;
  SubscribingEnd end{peer.place(), std::make_shared<Subscription>()};
};

}  // namespace

#define PEER_CASE(title, tags) CASE_IN(with_peer, (PlayedPeer & peer), title, tags)

PEER_CASE("objects go as frames until the client has heard the topic, and through the topic alone afterwards",
          "[patterns][dds]") {
  Publisher publisher(peer);
  const ObjectRef first = drive_ahead(), second = drive_ahead(), third = drive_ahead();
  CHECK(publisher.push(first) == Sent::yes);
  CHECK(kinds_of(peer.heard()) == Kinds{Parcel::frame});
  peer.say(Parcel::heard);
  CHECK(publisher.push(second) == Sent::yes);
  const auto said = peer.heard();
  REQUIRE(kinds_of(said) == Kinds{Parcel::direct});
  CHECK(numbers_in(said[0].contents) == Numbers{kSubscription, kBit, 1});
  CHECK(publisher.push(third) == Sent::yes);
  CHECK(peer.heard().empty());
  publisher.publication->flush();
  peer.outbox().end();
  const auto written = publisher.topic->objects();
  REQUIRE(written.size() == 3);
  CHECK(written[0].label.edges == 0);  // written only to be heard
  CHECK(written[1].label.edges == kBit);
  CHECK(written[1].label.epoch == 1);
  CHECK(written[2].label.edges == kBit);
}

PEER_CASE("each subscription is told anew from where on its objects come through the topic",
          "[patterns][dds]") {
  Publisher publisher(peer);
  peer.say(Parcel::heard);
  for (const std::uint64_t subscription : {1U, 2U}) {
    CHECK(publisher.push(drive_ahead(), subscription) == Sent::yes);
    const auto said = peer.heard();
    REQUIRE(kinds_of(said) == Kinds{Parcel::direct});
    CHECK(numbers_in(said[0].contents) == Numbers{subscription, kBit, subscription});
  }
}

PEER_CASE("an object for whose place its publisher waits is a frame, whatever the client has heard",
          "[patterns][dds]") {
  Publisher publisher(peer);
  peer.say(Parcel::heard);
  CHECK(publisher.push(drive_ahead(), kSubscription, 1) == Sent::yes);
  CHECK(kinds_of(peer.heard()) == Kinds{Parcel::frame});
}

PEER_CASE("a client that was started again gets frames until it has heard the topic, too",
          "[patterns][dds]") {
  Publisher publisher(peer);
  peer.say(Parcel::heard);
  CHECK(publisher.push(drive_ahead()) == Sent::yes);
  peer.line().lose(fail(Code::unavailable, "it is said to be gone"));
  peer.strand().take_in();
  CHECK(publisher.push(drive_ahead()) == Sent::cut);
  (void)peer.heard();
  peer.meet(6);
  peer.strand().take_in();
  CHECK(publisher.told.renewals == 1);
  CHECK(publisher.push(drive_ahead()) == Sent::yes);
  CHECK(kinds_of(peer.heard()) == Kinds{Parcel::frame});
}

PEER_CASE("an object for which the topic has no room is refused", "[patterns][dds]") {
  Publisher publisher(peer);
  peer.say(Parcel::heard);
  publisher.topic->queued = 4 * kMebibyte;
  CHECK(publisher.push(drive_ahead()) == Sent::no_room);
}

PEER_CASE("the end of an edge gives its bit of the topic back", "[patterns][dds]") {
  const auto publication = std::make_shared<Publication>(peer.outbox(), std::make_shared<NotedTopic>());
  const auto bit = publication->reserve();
  REQUIRE(bit);
  { const PublishingEnd end(peer.place(), publication, *bit); }
  CHECK(publication->reserve() == bit);
}

PEER_CASE("a client reports once that it has heard the topic, and no stranger counts", "[patterns][dds]") {
  Reader reader(peer);
  reader.come(0, 0, 0, 1, Origin{std::byte{3}});
  CHECK(peer.heard().empty());
  reader.come(0, 0);
  reader.come(0, 0);
  const auto said = peer.heard();
  REQUIRE(kinds_of(said) == Kinds{Parcel::heard});
  CHECK(said[0].by == By::next);  // it is not worth a wake
  peer.line().lose(fail(Code::unavailable, "it is said to be gone"));
  peer.meet(6);
  (void)peer.heard();
  reader.come(0, 0);
  CHECK(kinds_of(peer.heard()) == Kinds{Parcel::heard});
}

PEER_CASE("of the objects on the topic a client gets those that are due for it, from where it was told on",
          "[patterns][dds]") {
  Reader reader(peer);
  reader.come(kBit, 1);  // before: it has come as a frame
  reader.come(kBit, 2);  // kept until it is known that it counts
  reader.go_direct(2);
  reader.come(kBit + 1, 2);
  reader.come(kBit, 3);
  reader.come(1, 3);  // of other edges
  reader.come(kBit, 1);
  reader.take_in();
  CHECK(reader.told.objects() == 3);
  CHECK(reader.told.numbers == Numbers(3, kSubscription));
  CHECK(reader.told.lost == 0);
}

PEER_CASE("a new subscription knows nothing of what the topic has brought for the one before",
          "[patterns][dds]") {
  for (const FrameKind kind : {FrameKind::attach, FrameKind::detach}) {
    Reader reader(peer);
    reader.go_direct(1);
    CHECK(reader.end.send(Frame(kind, 4)) == Sent::yes);
    reader.come(kBit, 5);  // held, since nobody has told this subscription where it begins
    reader.take_in();
    CHECK(reader.told.objects() == 0);
    reader.go_direct(5);
    reader.take_in();
    CHECK(reader.told.objects() == 1);
  }
  Reader reader(peer);
  reader.go_direct(1);
  CHECK(reader.end.send(Frame(FrameKind::change, 4)) == Sent::yes);
  reader.come(kBit, 1);  // another rate is no other subscription
  reader.take_in();
  CHECK(reader.told.objects() == 1);
}

PEER_CASE("samples that the topic has lost count for a client by the share that it would have got",
          "[patterns][dds]") {
  Reader reader(peer);
  reader.go_direct(1);
  reader.come(kBit, 1, 3);
  reader.take_in();
  CHECK(reader.told.lost == 3);
  Frame grant(FrameKind::granted, kSubscription);
  for (const std::uint64_t number : {1'000U, 4U, 4'000U}) grant.add(number);
  peer.say(grant);
  reader.come(1, 1, 8);  // also where the sample itself is for others
  reader.come(kBit, 1, 3);
  reader.take_in();
  CHECK(reader.told.lost == 3 + 8 / 4);
}

PEER_CASE("a client that does not keep up loses new objects of the topic above 4 MiB, and counts them",
          "[patterns][dds]") {
  Reader reader(peer);
  reader.go_direct(1);
  for (int i = 0; i < 5; ++i) reader.come(kBit, 1, 0, kLarge);
  reader.take_in();
  CHECK(reader.told.objects() == 3);
  CHECK(reader.told.lost == 2);
  reader.come(kBit, 1);  // there is room again
  reader.take_in();
  CHECK(reader.told.objects() == 4);
}

PEER_CASE("of the objects that wait to be due the oldest are lost above 4 MiB, and counted",
          "[patterns][dds]") {
  Reader reader(peer);
  for (int i = 0; i < 4; ++i) reader.come(kBit, 1, i == 0 ? 2 : 0, kLarge);
  reader.come(0, 1, 0, kLarge);  // is for nobody and takes no room
  reader.go_direct(1);
  reader.take_in();
  CHECK(reader.told.objects() == 2);
  CHECK(reader.told.lost == 2 + 2);
}

PEER_CASE("one object may wait to be due, however large it is", "[patterns][dds]") {
  Reader reader(peer);
  reader.come(kBit, 1, 0, 5 * kMebibyte);
  reader.go_direct(1);
  reader.take_in();
  CHECK(reader.told.objects() == 1);
  CHECK(reader.told.lost == 0);
}

PEER_CASE("what does not say from where on the topic counts is not believed", "[patterns][dds]") {
  Reader reader(peer);
  reader.come(kBit, 1);
  peer.say(Parcel::direct, {kSubscription, kBit});
  peer.say(Parcel::direct, {kSubscription});
  peer.say(Parcel::direct);
  reader.take_in();
  CHECK(reader.told.objects() == 0);
}
