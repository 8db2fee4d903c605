// SPDX-License-Identifier: GPL-3.0-or-later
// Faults of a line: each can be asked for, is counted, and comes again with the same seed.
#include <catch2/catch.hpp>

#include "link_talk.hpp"
#include "orca/hw/link/faulty_link.hpp"
#include "orca/hw/link/memory_link.hpp"

using namespace orca;
using namespace orca::test;
using hw::link::Direction;
using hw::link::Fault;
using hw::link::FaultModes;
using hw::link::FaultPlan;
using hw::link::FaultyLink;
using hw::link::kMostPending;

namespace {

// A faulty line in memory, on a clock of the test's own.
struct FaultyLine {
  TimePoint time{100s};
  std::unique_ptr<hw::link::MemoryLink> device;
  std::unique_ptr<FaultyLink> link;

  explicit FaultyLine(FaultPlan plan = {}) {
    auto [near_end, far_end] = make_memory_ends();
    plan.now = [this] { return time; };
    link = std::make_unique<FaultyLink>(std::move(near_end), std::move(plan));
    device = std::move(far_end);
    must_open(*link);
    must_open(*device);
  }
  void set(const FaultModes& modes) { link->set_modes(modes); }
};

FaultPlan noisy(std::uint64_t seed) {
  FaultPlan plan;
  plan.seed = seed;
  plan.in = {0.05, 0.05, 0.05, 0.05};
  plan.out = {0.05, 0.05, 0.05, 0.05};
  return plan;
}

// Sends 2000 zeros each way, in pieces of a size, and returns what arrives: at the link, then at the device.
Bytes arrivals(FaultyLine& line, std::size_t piece) {
  Bytes in;
  Bytes out;
  for (std::size_t sent = 0; sent < 2000; sent += piece) {
    const Bytes zeros(std::min(piece, 2000 - sent), 0);
    must_write(*line.device, zeros);
    must_write(*line.link, zeros);
    for (Bytes some = read_some(*line.link); !some.empty(); some = read_some(*line.link))
      in.insert(in.end(), some.begin(), some.end());
    const Bytes some = read_some(*line.device);
    out.insert(out.end(), some.begin(), some.end());
  }
  in.insert(in.end(), out.begin(), out.end());
  return in;
}

FaultPlan scripted(std::vector<hw::link::ScriptedFault> script) {
  FaultPlan plan;
  plan.script = std::move(script);
  return plan;
}

}  // namespace

TEST_CASE("the same seed gives the same faults, in whatever pieces the bytes come", "[hw][link][faults]") {
  FaultyLine first(noisy(4));
  FaultyLine second(noisy(4));
  FaultyLine other(noisy(5));
  const Bytes expected = arrivals(first, 1);
  CHECK(arrivals(second, 333) == expected);
  CHECK(arrivals(other, 1) != expected);
  for (const Fault fault : {Fault::drop, Fault::flip, Fault::insert, Fault::duplicate}) {
    CHECK(first.link->count(fault) == second.link->count(fault));
    CHECK(first.link->count(fault) > 100);  // 200 of 4000 are expected
    CHECK(first.link->count(fault) < 300);
  }
}

TEST_CASE("what is counted is what arrives differently", "[hw][link][faults]") {
  FaultyLine line(noisy(11));
  const Bytes all = arrivals(line, 100);
  const FaultyLink& link = *line.link;
  CHECK(all.size() ==
        4000 - link.count(Fault::drop) + link.count(Fault::insert) + link.count(Fault::duplicate));
  FaultPlan flips;
  flips.in.flip = 0.1;
  FaultyLine flipped(flips);
  std::uint64_t changed = 0;
  for (const std::uint8_t byte : arrivals(flipped, 100)) changed += byte != 0;
  CHECK(changed == flipped.link->count(Fault::flip));
  CHECK(changed > 0);
}

TEST_CASE("a fault in the script befalls its byte", "[hw][link][faults]") {
  FaultyLine line(scripted({{Direction::in, 1, Fault::drop},
                            {Direction::in, 1, Fault::flip, 0x01},
                            {Direction::in, 2, Fault::flip, 0x80},
                            {Direction::in, 3, Fault::insert, 0x55},
                            {Direction::in, 4, Fault::duplicate},
                            {Direction::out, 0, Fault::drop}}));
  must_write(*line.device, {1, 2});
  must_write(*line.device, {3, 4, 5, 6});
  CHECK(read_some(*line.link) == Bytes{1, 0x83, 0x55, 4, 5, 5, 6});
  must_write(*line.link, {8, 9});
  CHECK(read_some(*line.device) == Bytes{9});
  CHECK(line.link->count(Fault::drop) == 2);
  CHECK(line.link->count(Fault::flip) == 1);
  CHECK(line.link->count(Fault::insert) == 1);
  CHECK(line.link->count(Fault::duplicate) == 1);
}

TEST_CASE("a device that falls silent by the script says nothing from that byte on", "[hw][link][faults]") {
  FaultyLine line(scripted({{Direction::in, 2, Fault::silence}}));
  must_write(*line.device, {1, 2, 3, 4});
  CHECK(read_some(*line.link) == Bytes{1, 2});
  must_write(*line.device, {5});
  CHECK(read_some(*line.link).empty());
  CHECK(line.link->count(Fault::silence) == 3);
  CHECK(line.link->modes().silent);
  line.set({});
  must_write(*line.device, {6});
  CHECK(read_some(*line.link) == Bytes{6});
}

TEST_CASE("a device that goes by the script is gone in mid-packet, until it is back", "[hw][link][faults]") {
  FaultyLine line(scripted({{Direction::in, 2, Fault::end}}));
  must_write(*line.device, {1, 2, 3, 4});
  CHECK(read_some(*line.link) == Bytes{1, 2});
  CHECK(error_of_reading(*line.link) == Code::unavailable);
  CHECK(line.link->write(bytes_of("x")).error().code == Code::unavailable);
  CHECK(line.link->count(Fault::end) == 1);
  line.link->close();
  CHECK(line.link->open().error().code == Code::unavailable);
  line.set({});
  must_open(*line.link);
  must_write(*line.device, {5});
  CHECK(read_some(*line.link) == Bytes{5});
}

TEST_CASE("a device that takes no bytes holds up nobody, and gets them when it goes on",
          "[hw][link][faults]") {
  FaultyLine line;
  FaultModes modes;
  modes.refuses = true;
  line.set(modes);
  must_write(*line.link, bytes_of("waits "));
  CHECK(line.link->pending() == 6);
  CHECK(read_some(*line.device).empty());
  CHECK(line.link->write(Bytes(kMostPending)).error().code == Code::deadline_exceeded);
  CHECK(line.link->count(Fault::refusal) == 2);
  line.set({});
  must_write(*line.link, bytes_of("and goes"));
  CHECK(text_of(read_some(*line.device)) == "waits and goes");
  CHECK(line.link->pending() == 0);

  line.set(modes);
  must_write(*line.link, bytes_of("dropped"));
  line.link->discard_output();
  line.set({});
  CHECK(line.link->flush().ok());
  CHECK(read_some(*line.device).empty());
}

TEST_CASE("a line with an echo gives back what is written", "[hw][link][faults]") {
  FaultyLine line;
  FaultModes modes;
  modes.echo = true;
  line.set(modes);
  must_write(*line.link, bytes_of("abc"));
  CHECK(text_of(read_some(*line.link)) == "abc");
  CHECK(text_of(read_some(*line.device)) == "abc");
  CHECK(line.link->count(Fault::echo) == 3);
}

TEST_CASE("input that is delayed comes after the delay", "[hw][link][faults]") {
  FaultyLine line;
  FaultModes modes;
  modes.delay = 20ms;
  line.set(modes);
  must_write(*line.device, {1, 2});
  CHECK(read_some(*line.link).empty());
  line.time += 10ms;
  must_write(*line.device, {3});
  CHECK(read_some(*line.link).empty());
  line.time += 10ms;
  CHECK(read_some(*line.link) == Bytes{1, 2});
  line.time += 10ms;
  CHECK(read_some(*line.link) == Bytes{3});
  CHECK(line.link->count(Fault::delay) == 3);
}

TEST_CASE("bytes that are delayed are not overtaken by later ones", "[hw][link][faults]") {
  FaultyLine line;
  FaultModes modes;
  modes.delay = 20ms;
  line.set(modes);
  must_write(*line.device, {1});
  CHECK(read_some(*line.link).empty());
  line.set({});
  must_write(*line.device, {2});
  CHECK(read_some(*line.link).empty());
  line.time += 20ms;
  CHECK(read_some(*line.link) == Bytes{1, 2});
}

TEST_CASE("input that is glued comes in one piece", "[hw][link][faults]") {
  FaultyLine line;
  FaultModes modes;
  modes.glue = 30ms;
  line.set(modes);
  for (std::uint8_t byte = 1; byte <= 3; ++byte) {
    must_write(*line.device, {byte});
    CHECK(read_some(*line.link).empty());
    line.time += 10ms;
  }
  CHECK(read_some(*line.link) == Bytes{1, 2, 3});
  CHECK(line.link->count(Fault::glue) == 2);
}

TEST_CASE("input that is split comes byte by byte", "[hw][link][faults]") {
  FaultyLine line;
  FaultModes modes;
  modes.byte_by_byte = true;
  line.set(modes);
  must_write(*line.device, {1, 2, 3});
  CHECK(read_some(*line.link) == Bytes{1});
  CHECK(read_some(*line.link) == Bytes{2});
  CHECK(read_some(*line.link) == Bytes{3});
  CHECK(read_some(*line.link).empty());
  CHECK(line.link->count(Fault::split) == 2);
}

TEST_CASE("what was under way when the device went is read before that is told", "[hw][link][faults]") {
  FaultyLine line;
  FaultModes modes;
  modes.delay = 20ms;
  line.set(modes);
  must_write(*line.device, {1});
  line.device->close();
  CHECK(read_some(*line.link).empty());
  line.time += 20ms;
  CHECK(read_some(*line.link) == Bytes{1});
  CHECK(error_of_reading(*line.link) == Code::unavailable);
}

TEST_CASE("a line without faults counts none", "[hw][link][faults]") {
  FaultyLine line;
  CHECK(arrivals(line, 50) == Bytes(4000, 0));
  for (std::size_t i = 0; i < hw::link::kFaults; ++i) CHECK(line.link->count(static_cast<Fault>(i)) == 0);
}
