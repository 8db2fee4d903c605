// SPDX-License-Identifier: LGPL-3.0-or-later
#include "xr4000_session.hpp"

#include <string>

#include "orca/hw/xr4000/request.hpp"

namespace orca::hw::xr4000 {
namespace {

constexpr Duration kAnswerTime = 250ms;
constexpr int kTries = 4;
constexpr std::uint8_t kXr4000 = 'x';

}  // namespace

Status XrSession::begin(TimePoint now) {
  tries_ = 0;
  found_ = echoes_ = false;
  return call(now);
}

Status XrSession::call(TimePoint now) {
  frames_ = LineFrames(kProtocol);
  link_.discard_input();
  return ask(hello(), now);
}

Result<bool> XrSession::advance(TimePoint now) {
  Status met;
  const Status read = receive(now, [&](const Message& answer, TimePoint) {
    if (met.ok() && answer.type == Type::hello) met = meet(answer);
  });
  if (!read.ok()) return read.error();
  if (!met.ok()) return met.error();
  if (found_ || asked_) return found_;
  if (++tries_ >= kTries) {
    tries_ = 0;
    return nobody();
  }
  if (Status called = call(now); !called.ok()) return called.error();
  return false;
}

Status XrSession::meet(const Message& answer) {
  const Result<Agent> agent = parse_hello(answer);
  if (!agent) return agent.error();
  if (agent->version != kVersion)
    return fail(Code::unavailable, "the agent speaks version " + std::to_string(agent->version) +
                                       " of the protocol and this driver version " +
                                       std::to_string(kVersion) + "; build both from one source");
  if (agent->robot_type != kXr4000)
    return fail(Code::unavailable, "the agent's robot has the type " + std::to_string(agent->robot_type) +
                                       ", and an XR4000 has " + std::to_string(kXr4000) + " ('x')");
  found_ = true;
  return ok();
}

Error XrSession::nobody() const {
  if (echoes_)
    return fail(Code::not_found, link_.name() +
                                     " sends back what it is sent, and nothing else: no robot, but a loop; "
                                     "is the cable plugged into the robot's computer, and does the agent "
                                     "run there?");
  return fail(Code::not_found, "no agent of an XR4000 answers at " + link_.name() +
                                   "; is the robot switched on, and does the agent run on its computer "
                                   "(docs/hardware/xr4000.md)?");
}

Status XrSession::ask(const Frame& request, TimePoint now) {
  asked_ = message_of(request.view()).type;
  deadline_ = now + kAnswerTime;
  return link_.write(request.view());
}

Status XrSession::receive(TimePoint now, const Take& take) {
  const std::uint64_t spoiled = frames_.statistics().bad_checksums;
  const Status read = frames_.read(
      link_, now, [&](const framing::Frame& frame, TimePoint stamp) { take_frame(frame, stamp, take); });
  if (asked_ && now >= deadline_) {  // the end of its answer was lost
    asked_.reset();
    frames_.give_up([&](const framing::Frame& frame, TimePoint stamp) { take_frame(frame, stamp, take); });
  }
  // An answer that was spoiled is an answer: the agent waits for the next request.
  if (frames_.statistics().bad_checksums != spoiled) asked_.reset();
  return read;
}

void XrSession::take_frame(const framing::Frame& frame, TimePoint stamp, const Take& take) {
  const Message message = message_of(frame.bytes);
  if (!message.is_answer) {
    echoes_ = true;
    return;
  }
  if (asked_ == message.type) asked_.reset();
  take(message, stamp);
}

}  // namespace orca::hw::xr4000
