// SPDX-License-Identifier: LGPL-3.0-or-later
#include "scout_session.hpp"

#include <cmath>
#include <string>

#include "orca/hw/nomad_scout/command.hpp"

namespace orca::hw::nomad_scout {
namespace {

constexpr Duration kAnswerTime = 250ms;      // beside what the bytes take
constexpr double kExchange = 62.0;           // [bytes] of a command and of the state
constexpr std::size_t kLongestCommand = 17;  // [bytes] of the payloads that we send; each state has more
constexpr int kRefusals = 5;                 // NAKs one after the other until we give up

Duration line_time(double bytes, const link::ByteLink& link) {
  return Duration(std::llround(1e9 * bytes * link.byte_time()));
}

}  // namespace

Status ScoutSession::begin(TimePoint now) {
  refusals_ = 0;
  heard_ = false;
  first_.reset();
  if (Status set = search_.begin(); !set.ok()) return set;
  return call(now);
}

Status ScoutSession::call(TimePoint now) {
  frames_ = LineFrames(kProtocol);
  link_.discard_input();
  return ask(get_state(), now);
}

Result<bool> ScoutSession::advance(TimePoint now) {
  const auto meet = [this](const Answer& answer) { first_ = answer; };
  if (Status heard = receive(now, meet); !heard.ok()) return heard.error();
  if (first_) return true;
  if (asked_) return false;
  const Result<bool> called = search_.next();
  if (!called) return called.error();
  if (!*called) return nobody();
  if (Status asked = call(now); !asked.ok()) return asked.error();
  return false;
}

Error ScoutSession::nobody() const {
  if (heard_)
    return fail(Code::not_found,
                search_.where() +
                    " sends back what it is sent, and nothing else: no robot, but a loop; is "
                    "the cable plugged into the robot, and is the robot switched on?");
  return fail(Code::not_found, "no Scout answers at " + search_.where() +
                                   "; is it switched on, is this its serial port, and is the cable crossed "
                                   "as it needs?");
}

Status ScoutSession::ask(const Packet& packet, TimePoint now) {
  asked_ = message_of(packet.view()).type;
  deadline_ = now + kAnswerTime + line_time(kExchange, link_);
  return link_.write(packet.view());
}

Status ScoutSession::receive(TimePoint now, const Take& take) {
  const std::uint64_t spoiled = frames_.statistics().bad_checksums;
  Status taken = read(now, take);
  if (asked_ && now >= deadline_) {  // the end of its answer was lost
    asked_.reset();
    frames_.give_up([&](const framing::Frame& frame, TimePoint stamp) {
      if (taken.ok()) taken = take_frame(frame, stamp, take);
    });
  }
  // An answer that was spoiled is an answer: the robot waits for the next command.
  if (frames_.statistics().bad_checksums != spoiled) asked_.reset();
  return taken;
}

Status ScoutSession::read(TimePoint now, const Take& take) {
  Status taken;
  Status read = frames_.read(link_, now, [&](const framing::Frame& frame, TimePoint stamp) {
    if (taken.ok()) taken = take_frame(frame, stamp, take);
  });
  return taken.ok() ? read : taken;
}

Status ScoutSession::take_frame(const framing::Frame& frame, TimePoint stamp, const Take& take) {
  const Message message = message_of(frame.bytes);
  heard_ = true;
  if (message.type == Type::nak) return take_refusal();
  if (message.payload.size() <= kLongestCommand || !is_answered_by_state(message.type))
    return ok();  // an echo
  const Result<State> state = parse_state(message);
  if (!state) return state.error();
  if (asked_ == message.type) asked_.reset();
  refusals_ = 0;
  take({message.type, *state, stamp});
  return ok();
}

Status ScoutSession::take_refusal() {
  const int command = static_cast<int>(asked_.value_or(Type::nak));
  asked_.reset();
  if (++refusals_ < kRefusals) return ok();
  return fail(Code::unavailable, "the robot does not understand the command " + std::to_string(command) +
                                     " (NAK); is it a Scout, and is its line free of noise?");
}

}  // namespace orca::hw::nomad_scout
