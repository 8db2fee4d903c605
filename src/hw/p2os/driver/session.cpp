// SPDX-License-Identifier: LGPL-3.0-or-later
#include "session.hpp"

#include <utility>

#include "orca/hw/p2os/sip.hpp"

namespace orca::hw::p2os {
namespace {

constexpr Duration kAnswerTime = 250ms;        // for an answer to SYNC; at 9600 baud it takes 30 ms
constexpr Duration kFirstPacketTime = 1500ms;  // for the first SIP after OPEN
constexpr Duration kClosingTime = 400ms;       // until an old connection is closed
constexpr int kTries = 3;                      // at each rate

}  // namespace

Session::Session(link::ByteLink& link, std::vector<std::uint32_t> rates)
    : link_(link), rates_(std::move(rates)) {}

Status Session::begin(TimePoint now) {
  rate_ = 0;
  tries_ = 0;
  heard_ = false;
  identity_ = {};
  frames_ = LineFrames(kProtocol);
  if (Status set = link_.set_line({.baud = rates_[0]}); !set.ok()) return set;
  link_.discard_input();
  return say(Step::sync0, now);
}

Status Session::say(Step step, TimePoint now) {
  step_ = step;
  switch (step) {
    case Step::sync0:
    case Step::sync1:
    case Step::sync2: deadline_ = now + kAnswerTime; return send(sync(static_cast<int>(step)));
    case Step::first_packet: {
      deadline_ = now + kFirstPacketTime;
      if (Status opened = send(encode(Command::open)); !opened.ok()) return opened;
      return send(encode(Command::pulse));
    }
    case Step::closing: deadline_ = now + kClosingTime; return send(encode(Command::close));
    case Step::done: deadline_ = kForever; return ok();
  }
  return ok();
}

Result<bool> Session::advance(TimePoint now) {
  Status taken;
  Status read = receive(now, [&](const Received& packet) {
    heard_ = true;
    if (taken.ok()) taken = take(packet.body, now);
  });
  if (!read.ok()) return read.error();
  if (!taken.ok()) return taken.error();
  if (step_ == Step::done) return true;
  return now >= deadline_ ? try_again(now) : Result<bool>(false);
}

Status Session::take(std::span<const std::uint8_t> body, TimePoint now) {
  if (step_ == Step::done || step_ == Step::closing) return ok();  // what an old connection still sends
  if (is_sip(body)) return say(step_ == Step::first_packet ? Step::done : Step::closing, now);
  const std::optional<int> answer = sync_step(body);
  if (!answer || step_ == Step::first_packet || *answer != static_cast<int>(step_)) return ok();
  return greet(body, now);
}

// Takes the answer to the present step.
Status Session::greet(std::span<const std::uint8_t> body, TimePoint now) {
  if (step_ == Step::sync0) return say(Step::sync1, now);
  if (step_ == Step::sync1) return say(Step::sync2, now);
  identity_ = parse_identity(body).value_or(Identity{});
  if (identity_.subclass.empty())
    return fail(
        Code::failed_precondition,
        link_.name() +
            " sends back what it is sent: no robot, but a loop; is the cable plugged into the robot, and "
            "is local echo of the radio modem off?");
  return say(Step::first_packet, now);
}

// Nothing has answered in time.
Result<bool> Session::try_again(TimePoint now) {
  const bool next_rate = step_ != Step::closing && ++tries_ >= kTries;
  if (next_rate) {
    tries_ = 0;
    if (++rate_ == rates_.size()) {
      rate_ = 0;
      return nobody();
    }
    if (Status set = link_.set_line({.baud = rates_[rate_]}); !set.ok()) return set.error();
  }
  link_.discard_input();
  frames_ = LineFrames(kProtocol);
  if (Status said = say(Step::sync0, now); !said.ok()) return said.error();
  return false;
}

Error Session::nobody() const {
  std::string rates;
  for (const std::uint32_t rate : rates_) rates += (rates.empty() ? "" : ", ") + std::to_string(rate);
  const std::string where = link_.name() + (rates_.size() > 1 ? " at " + rates + " baud" : "");
  if (heard_)
    return fail(Code::not_found,
                "something at " + where +
                    " sends packets but does not finish the handshake; switch the robot off and on");
  return fail(Code::not_found, "no Pioneer answers at " + where +
                                   "; is it switched on, is this its serial port, and is the "
                                   "cable crossed as it needs?");
}

Status Session::receive(TimePoint now, const std::function<void(const Received&)>& take) {
  return frames_.read(link_, now, [&](const framing::Frame& frame, TimePoint stamp) {
    take({body_of(frame.bytes), stamp});
  });
}

}  // namespace orca::hw::p2os
