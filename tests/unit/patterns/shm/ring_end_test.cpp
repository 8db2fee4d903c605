// SPDX-License-Identifier: GPL-3.0-or-later
// The two ends of an edge in shared memory, both in this process, without tasks of their own.
#include "shm/ring_end.hpp"

#include <catch2/catch.hpp>

#include "case_in.hpp"
#include "executives.hpp"
#include "orca/base/log.hpp"
#include "two_processes.hpp"

using namespace orca;
using namespace orca::shm;
using namespace orca::test;
using frames::Frame;
using frames::FrameKind;
using frames::FrameReader;
using frames::Loss;
using frames::Sent;

namespace {

constexpr std::size_t kOneMebibyte = std::size_t{1} << 20;

// A frame that takes that many bytes, with a number at its head.
Frame sized_frame(std::size_t bytes, std::uint64_t number = 0) {
  Frame frame(FrameKind::answer, number);
  frame.add(std::string(bytes - frames::kShortest - sizeof(std::uint32_t), 'x'));
  return frame;
}

// One end, and what its handlers were told.
struct WatchedEnd {
  WatchedEnd(Executive& executive, Side side, const MemoryFile& file, DoorbellWord& of_peer)
      : strand(executive, {"end", 0}),
        end(side, map(file), strand,
            {"peer.port", &of_peer, [this](const Error& why) { why_cut_off = why.message; }},
            "a.out to b.in") {
    end.start({[this](FrameReader& frame) {
                 numbers.push_back(frame.number());
                 if (frame.kind() == FrameKind::give_up)
                   return Status(fail(Code::data_loss, "it is refused"));
                 (void)frame.read_text();
                 return ok();
               },
               [this](const Error& reason) { why_cut = reason.message; }, [this] { ++renewals; }});
  }
  Sent send(std::size_t bytes, std::uint64_t number, Loss loss = Loss::never) {
    return end.send(sized_frame(bytes, number), loss);
  }

  std::vector<std::uint64_t> numbers;
  std::string why_cut, why_cut_off;
  int renewals = 0;
  Strand strand;
  RingEnd end;
};

struct EndPair {
  EndPair(Executive& executive, std::size_t capacity)
      : file(RingSegment::create("a.out to b.in", capacity).value()),
        client(executive, Side::client, file, rings_server),
        server(executive, Side::server, file, rings_client) {}

  // Returns whether one of the words was rung since the last time.
  static bool was_rung(DoorbellWord& word) { return word.exchange(0) != 0; }

  MemoryFile file;
  DoorbellWord rings_server{0}, rings_client{0};
  WatchedEnd client, server;
};

void with_pair(const std::function<void(EndPair&)>& body, std::size_t capacity = 4096) {
  log::set_level(log::Level::error);  // being cut off is a warning
  run_on({}, [&](Executive& executive) {
    EndPair pair(executive, capacity);
    body(pair);
  });
  log::set_level(log::Level::info);
}

using FrameNumbers = std::vector<std::uint64_t>;

}  // namespace

#define PAIR_CASE(title, tags) CASE_IN(with_pair, (EndPair & pair), title, tags)

PAIR_CASE("frames pass through shared memory in order, both ways, and ring the other side",
          "[patterns][shm]") {
  CHECK_FALSE(pair.server.end.take_in());  // there is nothing yet
  CHECK(pair.client.send(100, 1) == Sent::yes);
  CHECK(EndPair::was_rung(pair.rings_server));
  CHECK(pair.client.send(100, 2) == Sent::yes);
  CHECK(pair.server.send(100, 3) == Sent::yes);
  CHECK(EndPair::was_rung(pair.rings_client));
  CHECK(pair.server.end.take_in());
  CHECK(pair.client.end.take_in());
  CHECK(pair.server.numbers == FrameNumbers{1, 2});
  CHECK(pair.client.numbers == FrameNumbers{3});
  CHECK(pair.server.end.counters().frames_received == 2);
  CHECK(pair.client.end.counters().frames_received == 1);
  CHECK_FALSE(pair.server.end.take_in());
  CHECK(pair.client.end.name() == "a.out to b.in");
}

PAIR_CASE("what finds no room is dropped if it may be, and otherwise kept until the other side has read",
          "[patterns][shm]") {
  CHECK(pair.client.send(3000, 1) == Sent::yes);
  CHECK(pair.client.send(3000, 2, Loss::allowed) == Sent::no_room);
  CHECK(pair.client.send(3000, 3) == Sent::yes);
  CHECK(pair.client.send(100, 4, Loss::allowed) == Sent::no_room);  // it must not overtake
  CHECK(pair.client.send(100, 5) == Sent::yes);
  CHECK(pair.server.end.take_in());
  CHECK(EndPair::was_rung(pair.rings_client));  // there is room again
  (void)EndPair::was_rung(pair.rings_server);
  CHECK_FALSE(pair.client.end.take_in());
  CHECK(EndPair::was_rung(pair.rings_server));
  CHECK(pair.server.end.take_in());
  CHECK(pair.server.numbers == FrameNumbers{1, 3, 5});
  CHECK_FALSE(EndPair::was_rung(pair.rings_client));  // nobody waits for room any more
  CHECK(pair.client.send(100, 6, Loss::allowed) == Sent::yes);
}

PAIR_CASE("a frame that never finds room is refused, whatever waits before it", "[patterns][shm]") {
  CHECK(pair.client.send(4096 - 8, 1) == Sent::yes);  // just fits, with its length
  CHECK(pair.client.send(4096, 2) == Sent::too_large);
  CHECK(pair.client.send(3000, 3) == Sent::yes);
  CHECK(pair.client.send(4096, 4) == Sent::too_large);
  CHECK(pair.client.send(4096 - 8, 5) == Sent::yes);
  for (int i = 0; i < 3; ++i) {
    (void)pair.server.end.take_in();
    (void)pair.client.end.take_in();
  }
  CHECK(pair.server.numbers == FrameNumbers{1, 3, 5});
}

TEST_CASE("a peer for which more than 64 MiB wait is cut off", "[patterns][shm]") {
  with_pair(
      [](EndPair& pair) {
        CHECK(pair.client.send(kOneMebibyte, 1) == Sent::yes);
        for (int i = 0; i < 64; ++i) CHECK(pair.client.send(kOneMebibyte, 2) == Sent::yes);
        (void)pair.client.end.take_in();
        CHECK_FALSE(pair.client.end.is_cut());
        CHECK(pair.client.send(kOneMebibyte, 3) == Sent::yes);
        CHECK(pair.client.send(100, 4) == Sent::cut);
        CHECK(pair.client.end.take_in());
        CHECK(pair.client.end.is_cut());
        CHECK(pair.client.end.counters().peers_cut_off == 1);
        CHECK(pair.client.why_cut_off == "68157440 bytes wait to be read by it");
        CHECK(pair.client.why_cut == pair.client.why_cut_off);
      },
      2 * kOneMebibyte);
}

PAIR_CASE("a peer that sends what is refused is cut off, and learns that this end has gone",
          "[patterns][shm]") {
  CHECK(pair.client.end.send(Frame(FrameKind::give_up, 1)) == Sent::yes);
  CHECK(pair.client.send(100, 2) == Sent::yes);
  CHECK(pair.server.end.take_in());
  CHECK(pair.server.numbers == FrameNumbers{1});
  CHECK(pair.server.why_cut == "it is refused");
  CHECK(pair.server.why_cut_off == "it is refused");
  CHECK(pair.server.end.counters().peers_cut_off == 1);
  CHECK(pair.server.send(100, 3) == Sent::cut);
  CHECK_FALSE(pair.server.end.take_in());
  CHECK(EndPair::was_rung(pair.rings_client));
  CHECK(pair.client.end.take_in());
  CHECK(pair.client.why_cut == "the other end of a.out to b.in has gone");
  CHECK(pair.client.why_cut_off.empty());
  CHECK(pair.client.end.counters().peers_cut_off == 0);  // that was no fault
}

PAIR_CASE("a frame with bytes left over cuts its sender off", "[patterns][shm]") {
  Frame frame = sized_frame(100);
  frame.add(std::string("more"));
  CHECK(pair.client.end.send(frame) == Sent::yes);
  CHECK(pair.server.end.take_in());
  CHECK(pair.server.end.is_cut());
}

PAIR_CASE("what was written before its writer went is still read", "[patterns][shm]") {
  CHECK(pair.client.send(100, 1) == Sent::yes);
  (void)EndPair::was_rung(pair.rings_server);
  pair.client.end.stop();
  CHECK(EndPair::was_rung(pair.rings_server));
  CHECK(pair.client.end.is_cut());
  CHECK(pair.server.end.take_in());
  CHECK(pair.server.numbers == FrameNumbers{1});
  CHECK(pair.server.why_cut == "the other end of a.out to b.in has gone");
}

PAIR_CASE("an end whose peer is gone gets another one in fresh memory, and nothing of the old one reaches it",
          "[patterns][shm]") {
  CHECK(pair.client.send(3000, 1) == Sent::yes);
  CHECK(pair.client.send(3000, 2) == Sent::yes);  // is kept
  pair.client.end.cut(fail(Code::unavailable, "it was killed"));
  CHECK_FALSE(pair.client.end.is_cut());  // until the strand looks
  CHECK(pair.client.end.take_in());
  CHECK(pair.client.end.is_cut());
  CHECK(pair.client.why_cut == "it was killed");
  CHECK(pair.client.renewals == 0);
  const MemoryFile fresh = RingSegment::create("a.out to b.in", 4096).value();
  WatchedEnd next(pair.server.strand.executive(), Side::server, fresh, pair.rings_client);
  pair.client.end.renew(map(fresh));
  CHECK(pair.client.end.take_in());
  CHECK(pair.client.renewals == 1);
  CHECK_FALSE(pair.client.end.is_cut());
  CHECK(pair.client.send(100, 3) == Sent::yes);
  CHECK(next.end.take_in());
  CHECK(next.numbers == FrameNumbers{3});
  CHECK_FALSE(pair.client.end.take_in());
}

PAIR_CASE("an end that is renewed without a word before says that its peer was replaced", "[patterns][shm]") {
  pair.client.end.renew(map(RingSegment::create("a.out to b.in", 4096).value()));
  CHECK(pair.client.end.take_in());
  CHECK(pair.client.why_cut == "its peer was replaced");
  pair.client.end.cut(fail(Code::unavailable, "it was killed"));
  pair.client.end.renew(map(RingSegment::create("a.out to b.in", 4096).value()));
  CHECK(pair.client.end.take_in());
  CHECK(pair.client.why_cut == "it was killed");  // the reason that came first
  CHECK(pair.client.renewals == 2);
}
