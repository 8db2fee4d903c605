// SPDX-License-Identifier: LGPL-3.0-or-later
#include "session.hpp"

#include <algorithm>
#include <iterator>
#include <utility>

#include "orca/hw/p2os/sip.hpp"

namespace orca::hw::p2os {
namespace {

using namespace std::chrono_literals;

constexpr Duration kAnswerTime = 250ms;        // for an answer to SYNC; at 9600 baud it takes 30 ms
constexpr Duration kFirstPacketTime = 1500ms;  // for the first SIP after OPEN
constexpr Duration kClosingTime = 400ms;       // until an old connection is closed
constexpr int kTries = 3;                      // at each rate
constexpr int kMostClosings = 5;               // before it is given up
constexpr Duration kSettingsTime = 400ms;      // for the settings, which take 120 ms at 9600 baud
constexpr int kSettingsTries = 2;
constexpr Duration kChangeTime = 100ms;  // from the last byte of HOSTBAUD until the other rate is in force
constexpr Duration kListenTime = 500ms;  // for a packet at another rate; they come every 100 ms
constexpr Duration kSettled = 10s;       // a robot that is lost sooner may be so because of its rate
constexpr int kMostMisses = 2;           // of the faster rate

// The argument of HOSTBAUD.
int code_of(std::uint32_t baud) {
  constexpr std::uint32_t kRates[] = {9600, 19200, 38400, 57600, 115200};
  return static_cast<int>(std::ranges::find(kRates, baud) - std::begin(kRates));
}

}  // namespace

Session::Session(link::ByteLink& link, std::vector<std::uint32_t> rates, bool speeds_up)
    : link_(link), rates_(std::move(rates)), speeds_up_(speeds_up) {}

Status Session::begin(TimePoint now) {
  heard_ = false;
  identity_ = {};
  closings_ = 0;
  if (fast_since_ && now - *fast_since_ < kSettled) ++misses_;
  fast_since_.reset();
  return search(now);
}

// Looks for the robot once at the rate of before, which it has if only the line was lost, and then at all.
Status Session::search(TimePoint now) {
  order_.clear();
  if (last_rate_ != 0 && last_rate_ != rates_[0]) order_.push_back(last_rate_);
  for (const std::uint32_t rate : rates_) order_.insert(order_.end(), kTries, rate);
  last_rate_ = 0;
  call_ = 0;
  return call(now);
}

Status Session::call(TimePoint now) {
  if (Status set = set_rate(order_[call_]); !set.ok()) return set;
  return say(Step::sync0, now);
}

Status Session::set_rate(std::uint32_t baud) {
  if (Status set = link_.set_line({.baud = baud}); !set.ok()) return set;
  rate_ = baud;
  link_.discard_input();
  frames_ = LineFrames(kProtocol);
  return ok();
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
    case Step::settings: deadline_ = now + kSettingsTime; return send(encode(Command::config, 1));
    case Step::faster:
      deadline_ = now + kChangeTime;
      return send(encode(Command::hostbaud, code_of(kFastRate)));
    case Step::slower:
      deadline_ = now + kChangeTime;
      return send(encode(Command::hostbaud, code_of(order_[call_])));
    case Step::fast:
    case Step::slow: deadline_ = now + kListenTime; return send(encode(Command::pulse));
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
  if (now < deadline_) return false;
  if (Status tried = try_again(now); !tried.ok()) return tried.error();
  return step_ == Step::done;
}

Status Session::take(std::span<const std::uint8_t> body, TimePoint now) {
  switch (step_) {
    case Step::sync0:
    case Step::sync1:
    case Step::sync2: return is_sip(body) ? say(Step::closing, now) : greet(body, now);
    case Step::first_packet: {
      tries_ = 0;
      return is_sip(body) ? say(Step::settings, now) : ok();
    }
    case Step::settings: {
      if (auto config = parse_config(body)) config_ = std::move(config);
      return config_ ? choose_rate(now) : ok();
    }
    case Step::fast: {
      if (!is_sip(body)) return ok();
      fast_since_ = now;
      return finish(now);
    }
    case Step::slow: return is_sip(body) ? finish(now) : ok();
    default: return ok();  // what an old connection, or another rate, still brings
  }
}

// Takes the answer to the present step.
Status Session::greet(std::span<const std::uint8_t> body, TimePoint now) {
  if (sync_step(body) != static_cast<int>(step_)) return ok();
  if (step_ == Step::sync0) return say(Step::sync1, now);
  if (step_ == Step::sync1) return say(Step::sync2, now);
  identity_ = parse_identity(body).value_or(Identity{});
  if (identity_.subclass.empty())
    return fail(
        Code::failed_precondition,
        link_.name() +
            " sends back what it is sent: no robot, but a loop; is the cable plugged into the robot, and "
            "is local echo of the radio modem off?");
  config_.reset();
  return say(Step::first_packet, now);
}

// A link without a rate has only one.
Status Session::choose_rate(TimePoint now) {
  if (rates_.size() == 1 || rate_ >= kFastRate || !speeds_up_) return finish(now);
  if (!config_->resets_baud) {
    rate_trouble_ = "its controller does not return to its own rate by itself";
    return finish(now);
  }
  if (misses_ >= kMostMisses) return finish(now);
  const Result<bool> can = can_be_fast();
  if (!can) return can.error();
  return *can ? say(Step::faster, now) : finish(now);
}

// Looks whether the adapter has the faster rate, before the robot has it.
Result<bool> Session::can_be_fast() {
  const Status fast = link_.set_line({.baud = kFastRate});
  if (fast.ok()) {
    if (Status back = link_.set_line({.baud = rate_}); !back.ok()) return back.error();
    return true;
  }
  if (fast.error().code != Code::invalid_argument) return fast.error();
  misses_ = kMostMisses;
  rate_trouble_ = fast.error().message;
  return false;
}

Status Session::finish(TimePoint now) {
  last_rate_ = rate_;
  is_lost_at_change_ = false;
  if (rate_ >= kFastRate) rate_trouble_.clear();
  return say(Step::done, now);
}

// The last byte of the command for it must have gone at the old rate.
Status Session::change(std::uint32_t baud, Step step, TimePoint now) {
  if (link_.pending() > 0) {
    deadline_ = now + kChangeTime;
    return link_.flush();
  }
  const Status set = set_rate(baud);
  return set.ok() ? say(step, now) : set;
}

// Nothing has come in time.
Status Session::try_again(TimePoint now) {
  switch (step_) {
    case Step::closing: return ++closings_ < kMostClosings ? search(now) : Status(nobody());
    case Step::settings: return ++tries_ < kSettingsTries ? say(Step::settings, now) : finish(now);
    case Step::faster: return change(kFastRate, Step::fast, now);
    case Step::fast: return miss(now);
    case Step::slower: return change(order_[call_], Step::slow, now);
    case Step::slow: return lose_at_change(now);
    default: return call_again(now);
  }
}

// It does not hear or is not heard at the faster rate, or was never told of it.
Status Session::miss(TimePoint now) {
  ++misses_;
  rate_trouble_ = "nothing is heard of it at " + std::to_string(kFastRate);
  return say(Step::slower, now);
}

// It is heard at neither rate: whatever lies between may have only the old one.
Status Session::lose_at_change(TimePoint now) {
  misses_ = kMostMisses;
  is_lost_at_change_ = true;
  return search(now);
}

Status Session::call_again(TimePoint now) {
  if (++call_ < order_.size()) return call(now);
  call_ = 0;
  return nobody();
}

Error Session::nobody() const {
  const std::string where = hw::where(link_, rates_);
  if (is_lost_at_change_)
    return fail(
        Code::not_found,
        "the Pioneer at " + link_.name() + " was told to send at " + std::to_string(kFastRate) +
            " baud, and is not heard since; switch it off and on, and write speed_up=\"false\": does a "
            "radio modem with a fixed rate lie between?");
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
