// SPDX-License-Identifier: LGPL-3.0-or-later
#include "create2_session.hpp"

#include <array>

namespace orca::hw::create2 {
namespace {

constexpr Duration kFrameTime = 250ms;  // until the first frame of a stream; it takes 15 ms
constexpr int kFirstFrames = 4;         // until what is reported is surely of after the start command
constexpr double kSlowByte = 0.0002;    // [s] a line with slower bytes does not carry all packets

constexpr std::array kPackets{Packet::bumps_and_drops,
                              Packet::cliff_left,
                              Packet::cliff_front_left,
                              Packet::cliff_front_right,
                              Packet::cliff_right,
                              Packet::overcurrents,
                              Packet::mode,
                              Packet::left_counts,
                              Packet::right_counts,
                              Packet::voltage,
                              Packet::charging_state,
                              Packet::charge,
                              Packet::capacity,
                              Packet::charging_sources};
constexpr std::size_t kFewPackets = 10;  // of these, which fit into 15 ms at 19200 baud

// The start command leads to passive mode. Firmware of some Roombas 600 reports the number of each mode plus 1.
constexpr auto kPassivePlusOne = static_cast<Mode>(static_cast<int>(Mode::passive) + 1);

std::span<const Packet> packets_for(const link::ByteLink& link) {
  return std::span(kPackets).first(link.byte_time() > kSlowByte ? kFewPackets : kPackets.size());
}

}  // namespace

Status Create2Session::begin(TimePoint now) {
  found_ = false;
  mode_offset_ = 0;
  if (Status set = search_.begin(); !set.ok()) return set;
  return call(now);
}

// A command that was cut short may wait for its data, of which it takes at most four here.
Status Create2Session::call(TimePoint now) {
  deadline_ = now + kFrameTime;
  good_frames_ = 0;
  link_.discard_input();
  frames_ = LineFrames(kProtocol);
  if (!search_.is_first_call())
    for (int i = 0; i < 4; ++i)
      if (Status sent = send(encode(Order::start)); !sent.ok()) return sent;
  if (Status sent = send(encode(Order::start)); !sent.ok()) return sent;
  return send(stream(packets_for(link_)));
}

Result<bool> Create2Session::advance(TimePoint now) {
  const auto meet = [this](const Sensors& sensors, TimePoint) {
    if (!sensors.left_counts || ++good_frames_ < kFirstFrames) return;
    found_ = true;
    mode_offset_ = sensors.mode == kPassivePlusOne ? 1 : 0;
  };
  if (Status read = receive(now, meet); !read.ok()) return read.error();
  if (found_) return true;
  if (now < deadline_) return false;
  const Result<bool> called = search_.next();
  if (!called) return called.error();
  if (!*called) return nobody();
  if (Status sent = call(now); !sent.ok()) return sent.error();
  return false;
}

Error Create2Session::nobody() const {
  return fail(Code::not_found,
              "no Create 2 answers at " + search_.where() +
                  "; press its Clean button, for it may sleep; is its battery charged, and is "
                  "this its serial port?");
}

Status Create2Session::receive(TimePoint now, const Take& take) {
  return frames_.read(link_, now, [&](const framing::Frame& frame, TimePoint stamp) {
    std::optional<Sensors> sensors = parse_body(body_of(frame.bytes));
    if (!sensors) return;
    if (found_ && sensors->mode)
      sensors->mode = static_cast<Mode>(static_cast<int>(*sensors->mode) - mode_offset_);
    take(*sensors, stamp);
  });
}

}  // namespace orca::hw::create2
