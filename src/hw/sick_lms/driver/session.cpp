// SPDX-License-Identifier: LGPL-3.0-or-later
#include "session.hpp"

#include <algorithm>
#include <array>
#include <optional>

#include "orca/base/text.hpp"
#include "orca/hw/sick_lms/scan.hpp"

namespace orca::hw::sick_lms {
namespace {

constexpr std::array<std::uint32_t, 4> kRates{38400, 9600, 19200, 500000};
constexpr std::uint32_t kFastest = 500000;
constexpr std::chrono::microseconds kPause{60};  // between bytes at that rate; the laser needs 55
constexpr Duration kAnswerTime = 250ms;          // beside a scan that is on its way
constexpr Duration kModeTime = 3s;
constexpr Duration kWriteTime = 15s;
constexpr Duration kSettleTime = 500ms;  // after a change of the rate
constexpr int kTries = 3;

bool has_bits_of(std::uint8_t mode, std::uint8_t wished) {
  return distance_mask(mode) && distance_mask(mode) == distance_mask(wished);
}

std::string at_rate(std::uint32_t baud) { return std::to_string(baud) + " baud"; }

}  // namespace

Session::Session(link::ByteLink& link, const Wishes& wishes, bool has_rate)
    : link_(link), wishes_(wishes), has_rate_(has_rate), order_(kRates.begin(), kRates.end()) {}

Status Session::begin(TimePoint now) {
  patient_until_ = saturating_add(now, wishes_.patience);
  std::ranges::stable_partition(order_, [&](std::uint32_t baud) { return baud == last_rate_; });
  return find_from(0, now);
}

// Looks for the laser at the next rate that the line can have. One that has been lost for a moment still has the rate of before.
Status Session::find_from(std::size_t index, TimePoint now) {
  const std::size_t rates = has_rate_ ? order_.size() : 1;
  for (index_ = index; index_ < rates; ++index_) {
    if (Status set = set_rate(order_[index_]); !set.ok()) {
      if (set.error().code != Code::invalid_argument) return set;
      continue;
    }
    link_.discard_input();
    scanner_ = framing::Scanner(kFromLaser);
    arrivals_ = {};
    return say(Step::find, now);
  }
  return index > 0 && now < patient_until_ ? find_from(0, now) : Status(nobody());
}

Status Session::set_rate(std::uint32_t baud) {
  if (Status set = link_.set_line({.baud = baud, .pause = baud < kFastest ? 0us : kPause}); !set.ok())
    return set;
  rate_ = baud;
  return ok();
}

Status Session::say(Step step, TimePoint now) {
  step_ = step;
  tries_ = 0;
  return say_again(now);
}

Status Session::say_again(TimePoint now) {
  ++tries_;
  deadline_ = step_ == Step::done ? kForever : now + patience();
  if (step_ == Step::done || step_ == Step::settle) return ok();
  const Result<Telegram> telegram = request();
  return telegram ? send(*telegram) : Status(telegram.error());
}

Result<Telegram> Session::request() const {
  switch (step_) {
    case Step::type: return request_type();
    case Step::read: return request_configuration();
    case Step::install: return request_installation(type_.starts_with("PLS") ? kPlsPassword : kLmsPassword);
    case Step::write: return write_configuration(configuration_.bytes());
    case Step::rate: return request_rate(wanted_);
    case Step::confirm: return request_status();
    case Step::variant: return request_variant(wishes_.variant);
    default: return request_mode(Mode::on_request);  // which stops what is being sent
  }
}

Duration Session::patience() const {
  const Duration answer = kAnswerTime + line_time(kLongestTelegram, rate_);
  switch (step_) {
    case Step::install:
    case Step::leave:
    case Step::rate: return answer + kModeTime;
    case Step::write: return answer + kWriteTime;
    case Step::settle: return kSettleTime;
    default: return answer;
  }
}

Result<bool> Session::advance(TimePoint now) {
  Status taken;
  Status read = receive(now, [&](const Received& received) {
    if (taken.ok()) taken = take(received.reply, now);
  });
  if (!read.ok()) return read.error();
  if (taken.ok() && now >= deadline_) taken = give_up(now);
  if (!taken.ok()) return taken.error();
  return step_ == Step::done;
}

Status Session::take(const Reply& reply, TimePoint now) {
  if (step_ == Step::done) return ok();
  if (reply.code == ReplyCode::power_on) return say(Step::find, now);  // it begins anew at this rate
  return answers(reply) ? take_answer(reply, now) : ok();
}

// Returns whether it is an answer to the present step, and no scan that was on its way.
bool Session::answers(const Reply& reply) const {
  const auto is_one_of = [&](ReplyCode answer) {
    return reply.code == answer || reply.code == ReplyCode::not_accepted;
  };
  switch (step_) {
    case Step::find: return parse_mode_answer(reply) == ModeAnswer::success;
    case Step::type: return is_one_of(ReplyCode::type);
    case Step::read: return is_one_of(ReplyCode::configuration);
    case Step::write: return is_one_of(ReplyCode::written);
    case Step::confirm: return is_one_of(ReplyCode::status);
    case Step::variant: return is_one_of(ReplyCode::variant);
    case Step::install:
    case Step::leave:
    case Step::rate: return is_one_of(ReplyCode::mode);
    default: return false;  // none comes
  }
}

Status Session::take_answer(const Reply& reply, TimePoint now) {
  const bool chosen = parse_mode_answer(reply) == ModeAnswer::success;
  switch (step_) {
    case Step::find: return say(Step::type, now);
    case Step::type: type_ = parse_type(reply).value_or(""); return say(Step::read, now);
    case Step::read: return take_configuration(reply, now);
    case Step::install: return chosen ? say(Step::write, now) : Status(refused("the password SICK_LMS"));
    case Step::write: return take_written(reply, now);
    case Step::leave: return chosen ? choose_rate(now) : Status(refused("to send scans"));
    case Step::rate: return take_rate(reply, now);
    case Step::confirm: return say(Step::variant, now);
    case Step::variant: return take_variant(reply, now);
    default: return ok();
  }
}

Status Session::take_written(const Reply& reply, TimePoint now) {
  const std::optional<WriteAnswer> answer = parse_written(reply);
  if (!answer || !answer->is_accepted) return refused("a configuration with the wished unit");
  configuration_ = answer->configuration;
  return say(Step::leave, now);
}

Status Session::take_variant(const Reply& reply, TimePoint now) {
  const std::optional<VariantAnswer> answer = parse_variant(reply);
  if (!answer || !answer->is_accepted || !(answer->variant == wishes_.variant))
    return refused("the wished angle and resolution; write another angle or resolution");
  last_rate_ = rate_;
  return say(Step::done, now);
}

Status Session::take_configuration(const Reply& reply, TimePoint now) {
  const std::optional<Configuration> found = parse_configuration(reply);
  if (!found) return refused("to tell its configuration");
  configuration_ = *found;
  const bool has_mode =
      has_bits_of(found->measuring_mode().value_or(wishes_.measuring_mode), wishes_.measuring_mode);
  if (found->unit() == wishes_.unit && has_mode) return choose_rate(now);
  if (Status set = configuration_.set_unit(wishes_.unit); !set.ok()) return set;
  if (!has_mode)
    if (Status set = configuration_.set_measuring_mode(wishes_.measuring_mode); !set.ok()) return set;
  return say(Step::install, now);
}

// Asks for the best rate that adapter and laser may have.
Status Session::choose_rate(TimePoint now) {
  const std::vector<std::uint32_t> best =
      wishes_.rate == 0 ? std::vector<std::uint32_t>{kFastest, 38400} : std::vector{wishes_.rate};
  for (const std::uint32_t baud : best) {
    if (!has_rate_ || baud == rate_) break;
    if (unusable_.contains(baud)) continue;
    const Result<bool> possible = can_have(baud);
    if (!possible) return possible.error();
    wanted_ = baud;
    if (*possible) return say(Step::rate, now);
    if (wishes_.rate != 0) miss_rate("the adapter cannot have it");
  }
  return say(Step::variant, now);
}

Result<bool> Session::can_have(std::uint32_t baud) {
  const std::uint32_t present = rate_;
  const Status tried = set_rate(baud);
  if (Status back = set_rate(present); !back.ok()) return back.error();
  if (!tried.ok() && tried.error().code != Code::invalid_argument) return tried.error();
  return tried.ok();
}

// The answer has come at the old rate.
Status Session::take_rate(const Reply& reply, TimePoint now) {
  if (parse_mode_answer(reply) != ModeAnswer::success) {
    miss_rate("the laser refuses it");
    return choose_rate(now);
  }
  if (Status set = set_rate(wanted_); !set.ok()) return set;
  return say(Step::settle, now);
}

void Session::miss_rate(const std::string& why) {
  unusable_.insert(wanted_);
  rate_trouble_ = "the line does not have " + at_rate(wanted_) + ": " + why;
}

// Nothing has answered in time.
Status Session::give_up(TimePoint now) {
  if (step_ == Step::settle) {
    link_.discard_input();
    return say(Step::confirm, now);
  }
  if (tries_ < kTries && step_ != Step::write) return say_again(now);
  if (step_ == Step::find) return find_from(index_ + 1, now);
  if (step_ != Step::confirm)
    return fail(
        Code::deadline_exceeded,
        "the laser at " + link_.name() +
            " answered first and then did not; is its cable loose, or another program talking to it?");
  miss_rate("since it was told to change to it, the laser is not heard; is it wired for RS-422?");
  return find_from(0, now);
}

Error Session::nobody() const {
  const std::string where = hw::where(link_, rates_of(link_, {kRates.begin(), kRates.end()}));
  if (own_.statistics().frames > 0)
    return fail(Code::not_found,
                where +
                    " sends back what it is sent, and no laser answers; is the cable plugged "
                    "into the laser, and does the adapter not echo?");
  if (!rate_trouble_.empty())
    return fail(Code::not_found, "no laser answers at " + where + " any more; " + rate_trouble_ +
                                     "; switch it off and on, and write rate=\"38400\"");
  return fail(Code::not_found, "no laser answers at " + where +
                                   "; is it switched on (then it needs up to a minute), is this "
                                   "its serial port, and are its two data lines crossed as they must be?");
}

Error Session::refused(const std::string& what) const {
  return fail(Code::failed_precondition, "the laser " + (type_.empty() ? "" : in_quotes(type_) + " ") +
                                             "at " + link_.name() + " does not accept " + what);
}

Status Session::receive(TimePoint now, const std::function<void(const Received&)>& take) {
  std::array<std::uint8_t, 1024> bytes{};
  for (;;) {
    const Result<std::size_t> count = link_.read(bytes);
    if (!count) return count.error();
    if (*count == 0) return ok();
    if (step_ == Step::find) own_.feed({bytes.data(), *count}, [](const framing::Frame&) {});
    arrivals_.note(scanner_.received() + *count, now, link_.byte_time());
    bool is_damaged = false;  // what we have sent
    scanner_.feed({bytes.data(), *count}, [&](const framing::Frame& frame) {
      const Heard what = heard(frame.bytes);
      is_damaged |= what == Heard::nak && frame.skipped == 0;
      if (what != Heard::telegram) return;
      const std::optional<Reply> reply = parse_reply(payload_of(frame.bytes));
      if (reply) take({*reply, arrivals_.of(frame.begin)});
    });
    arrivals_.forget(scanner_.received() - scanner_.waiting());
    if (is_damaged && step_ != Step::done && step_ != Step::settle) deadline_ = now;
  }
}

}  // namespace orca::hw::sick_lms
