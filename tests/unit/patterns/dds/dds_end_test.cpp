// SPDX-License-Identifier: GPL-3.0-or-later
// One end of an edge through DDS: what it sends, what waits for its strand, and when its peer is cut off.
#include "dds/backend/dds_end.hpp"

#include <catch2/catch.hpp>

#include "case_in.hpp"
#include "executives.hpp"
#include "orca/base/log.hpp"
#include "played_peer.hpp"

using namespace orca;
using namespace orca::dds;
using namespace orca::test;
using frames::Caller;
using frames::Frame;
using frames::FrameKind;
using frames::FrameReader;
using frames::Loss;
using frames::Sent;

namespace {

constexpr std::size_t kBehindAt = std::size_t{4} << 20;
constexpr std::size_t kMostUnread = std::size_t{64} << 20;
constexpr std::size_t kBesides = 64;  // bytes that are counted for each frame besides its own

// An end whose inner parts the test sees.
struct OpenEnd : DdsEnd {
  using DdsEnd::DdsEnd;
  using DdsEnd::deliver;
  using DdsEnd::is_behind;
  using DdsEnd::session;
};

Frame small(FrameKind kind = FrameKind::taken) {
  Frame frame(kind, 1);
  frame.add(std::uint64_t{2});
  return frame;
}

// A frame of that many bytes, of the kind whose text the fixture reads.
std::vector<std::byte> frame_of_size(std::size_t bytes) {
  Frame frame(FrameKind::attach, 1);
  frame.add(std::string(bytes - 2 * sizeof(std::uint64_t) - sizeof(std::uint32_t), 'x'));
  std::vector<std::byte> encoded;
  frame.append_to(encoded);
  REQUIRE(encoded.size() == bytes);
  return encoded;
}

struct Fixture {
  explicit Fixture(Executive& executive) : peer(executive), end(peer.place()) {
    end.start({[this](FrameReader& frame) {
                 log += "frame ";
                 if (frame.kind() == FrameKind::offer) return Status(fail(Code::data_loss, "it is refused"));
                 if (frame.kind() == FrameKind::attach) return (void)frame.read_text(), ok();
                 (void)frame.read_number();
                 return ok();
               },
               [this](const Error& reason) { log += "cut: " + reason.message + " "; },
               [this] { log += "renewed "; }});
  }
  ~Fixture() { end.stop(); }
  Fixture(const Fixture&) = delete;
  Fixture& operator=(const Fixture&) = delete;

  void take_in() { peer.strand().take_in(); }

  std::string log;
  PlayedPeer peer;
  OpenEnd end;
};

void with_end(const std::function<void(Fixture&)>& body) {
  log::set_level(log::Level::error);  // being cut off is a warning
  run_on({}, [&](Executive& executive) {
    Fixture fixture(executive);
    body(fixture);
  });
  log::set_level(log::Level::info);
}

}  // namespace

#define END_CASE(title, tags) CASE_IN(with_end, (Fixture & one), title, tags)

END_CASE("frames reach the strand in order when it takes them in, and are counted", "[patterns][dds]") {
  one.peer.meet();
  one.peer.say(small());
  one.peer.say(small());
  CHECK(one.log.empty());
  one.take_in();
  CHECK(one.log == "frame frame ");
  CHECK(one.end.traffic().frames_received == 2);
  CHECK_FALSE(one.end.take_in());  // there is nothing new
  CHECK(one.end.name() == "a.out to b.in");
}

END_CASE("a frame goes to the peer as a parcel, by whoever waits for what comes of it", "[patterns][dds]") {
  one.peer.meet();
  CHECK(one.end.send(small()) == Sent::yes);
  CHECK(one.end.send(small(), Loss::never, Caller::waits) == Sent::yes);
  const auto said = one.peer.heard();
  REQUIRE(said.size() == 2);
  CHECK(said[0].kind == Parcel::frame);
  FrameReader frame(said[0].contents);
  CHECK(frame.kind() == FrameKind::taken);
  CHECK(frame.read_number() == 2);
  CHECK(said[0].by == By::outbox);
  CHECK(said[1].by == By::caller);
}

END_CASE("a peer that sends what is refused is cut off, counted, told, and not heard any more",
         "[patterns][dds]") {
  one.peer.meet();
  one.peer.say(small(FrameKind::offer));
  one.peer.say(small());
  one.take_in();
  CHECK(one.log == "frame cut: it is refused ");
  CHECK(one.end.is_cut());
  CHECK(one.end.traffic().peers_cut_off == 1);
  CHECK(one.end.send(small()) == Sent::cut);
  const auto said = one.peer.heard();
  REQUIRE(said.size() == 1);
  CHECK(said[0].kind == Parcel::closed);
}

END_CASE("a frame with a field too many cuts its sender off", "[patterns][dds]") {
  one.peer.meet();
  Frame frame = small();
  frame.add(std::uint64_t{3});
  one.peer.say(frame);
  one.take_in();
  CHECK(one.end.is_cut());
}

END_CASE("an end whose other end has gone says so, once", "[patterns][dds]") {
  one.peer.meet();
  one.peer.say(Parcel::closed);
  one.peer.say(Parcel::closed);
  one.peer.say(Parcel::heard);  // is nothing for an end that has no topic
  one.take_in();
  CHECK(one.log == "cut: the other end of a.out to b.in has gone ");
  CHECK(one.end.traffic().peers_cut_off == 0);  // that is no fault
}

END_CASE("an end works again with a new peer, and tells of the old one's loss once", "[patterns][dds]") {
  one.peer.meet();
  CHECK(one.end.session() == 1);
  one.peer.line().lose(fail(Code::unavailable, "it was killed"));
  one.take_in();
  CHECK(one.end.is_cut());
  one.peer.meet(6);
  one.take_in();
  CHECK(one.log == "cut: it was killed renewed ");
  CHECK_FALSE(one.end.is_cut());
  CHECK(one.end.session() == 2);
  CHECK(one.end.send(small()) == Sent::yes);
}

END_CASE("a strand falls behind when more than 4 MiB wait for it, and catches up by taking in",
         "[patterns][dds]") {
  one.end.deliver(std::vector<std::byte>(kBehindAt - kBesides));
  CHECK_FALSE(one.end.is_behind());
  one.end.deliver({});
  CHECK(one.end.is_behind());
  one.take_in();
  CHECK_FALSE(one.end.is_behind());
}

TEST_CASE("64 MiB may wait for a strand, and a peer that sends more is cut off", "[patterns][dds]") {
  for (const std::size_t more : {0U, 1U}) {
    CAPTURE(more);
    with_end([more](Fixture& one) {
      one.peer.meet();
      one.end.deliver(frame_of_size(kMostUnread - kBesides + more));
      one.peer.say(small());
      one.take_in();
      CHECK(one.end.traffic().peers_cut_off == more);
      CHECK(one.log == (more == 0 ? "frame frame " : "frame cut: it sends more than is read "));
    });
  }
}

END_CASE("an end that was stopped is cut, and its peer learns of it", "[patterns][dds]") {
  one.peer.meet();
  one.peer.say(small());
  one.end.stop();
  one.end.stop();
  CHECK(one.end.is_cut());
  CHECK_FALSE(one.end.take_in());
  CHECK(one.log.empty());
  const auto said = one.peer.heard();
  REQUIRE(said.size() == 1);
  CHECK(said[0].kind == Parcel::closed);
}
