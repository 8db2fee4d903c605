// SPDX-License-Identifier: GPL-3.0-or-later
// RPLIDAR: a stream gives the same events however it is cut, and every point is within its range. Turns of the points
// have all their beams. The first byte chooses the pieces, and where in the stream a new answer is expected.
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <numbers>
#include <span>
#include <variant>
#include <vector>

#include "orca/hw/rplidar/receiver.hpp"
#include "orca/hw/rplidar/turns.hpp"

namespace {

using namespace orca::hw::rplidar;
using Input = std::span<const std::uint8_t>;

void check(const Point& point) {
  if (!(point.angle > -std::numbers::pi && point.angle <= std::numbers::pi)) std::abort();
  if (point.range && !(*point.range > 0.0 && *point.range < 16.4)) std::abort();
}

void hear(Receiver& receiver, Input stream, std::size_t piece, std::vector<Event>& events) {
  for (std::size_t at = 0; at < stream.size(); at += piece)
    receiver.feed(stream.subspan(at, std::min(piece, stream.size() - at)), [&](const Event& event) {
      if (const auto* const point = std::get_if<Point>(&event)) check(*point);
      events.push_back(event);
    });
}

std::vector<Event> events_of(Input stream, std::size_t piece, std::size_t next_request) {
  Receiver receiver;
  std::vector<Event> events;
  hear(receiver, stream.first(next_request), piece, events);
  receiver.expect_answer();
  hear(receiver, stream.subspan(next_request), piece, events);
  return events;
}

// Each turn has all its beams, and took some time, but not too long.
void collect(const std::vector<Event>& events) {
  TurnCollector turns(90);
  orca::TimePoint now{};
  for (const Event& event : events) {
    const auto* const point = std::get_if<Point>(&event);
    if (point == nullptr) continue;
    now += orca::Duration(500'000);
    const Turn* const turn = turns.add(*point, now);
    if (turn == nullptr) continue;
    if (turn->ranges.size() != 90 || turn->period > TurnCollector::kLongestTurn) std::abort();
    if (!std::ranges::all_of(turn->ranges, [](double range) { return range > 0.0; })) std::abort();
  }
}

void try_parts(Input bytes) {
  if (bytes.size() >= kNodeSize) (void)parse_node(bytes.first(kNodeSize));
  if (!bytes.empty() && look_at_capsule(bytes).kind == orca::hw::framing::Finding::Kind::frame)
    (void)parse_capsule(bytes.first(kCapsuleSize));
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size < 2) return 0;
  const Input rest(data + 1, size - 1);
  try_parts(rest);
  const std::size_t next_request = rest.size() * (data[0] % 8U) / 8U;
  const std::vector<Event> events = events_of(rest, rest.size(), next_request);
  if (events != events_of(rest, 1U + data[0] / 8U, next_request)) std::abort();
  collect(events);
  return 0;
}
