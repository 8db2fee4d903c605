// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rplidar_session.hpp"

#include <array>
#include <cstdio>
#include <utility>

#include "orca/hw/line_frames.hpp"
#include "orca/hw/rplidar/capsule.hpp"
#include "orca/hw/rplidar/node.hpp"

namespace orca::hw::rplidar {
namespace {

constexpr Duration kQuietTime = 20ms;  // behind a stop; the scanner needs 10
constexpr Duration kAnswerTime = 300ms;
constexpr Duration kBootTime = 2s;
constexpr Duration kScanTime = 1s;  // until a scan is announced
constexpr int kTries = 3;
constexpr SampleRates kUsualRates{500e-6, 250e-6};

}  // namespace

RplidarSession::RplidarSession(link::ByteLink& link, ScanMode mode) : link_(link), mode_(mode) {}

Status RplidarSession::begin(TimePoint now) {
  was_reset_ = has_rates_ = false;
  heard_bytes_ = 0;
  arrivals_ = {};
  before_ = {};
  receiver_ = {};
  rates_ = kUsualRates;
  if (Status set = link_.set_line({.baud = kBaud}); !set.ok()) return set;
  if (Status off = link_.set_dtr(true); !off.ok()) return off;
  return say(Step::quiet, now);
}

Status RplidarSession::scan(TimePoint now) {
  if (Status on = link_.set_dtr(false); !on.ok()) return on;
  return say(Step::hush, now);
}

void RplidarSession::rest() {
  (void)send(Request::stop);
  (void)link_.set_dtr(true);
  step_ = Step::done;
  deadline_ = kForever;
}

Status RplidarSession::say(Step step, TimePoint now) {
  step_ = step;
  tries_ = 0;
  return say_again(now);
}

Status RplidarSession::say_again(TimePoint now) {
  ++tries_;
  answered_ = false;
  deadline_ = saturating_add(now, patience(step_));
  return request(step_);
}

Duration RplidarSession::patience(Step step) {
  switch (step) {
    case Step::quiet:
    case Step::hush: return kQuietTime;
    case Step::boot: return kBootTime;
    case Step::scan: return kScanTime;
    case Step::spin: return kSpinTime;
    case Step::done:
    case Step::flow: return Duration::max();
    default: return kAnswerTime;
  }
}

Status RplidarSession::request(Step step) {
  switch (step) {
    case Step::quiet:
    case Step::hush: return send(Request::stop);
    case Step::info: return send(Request::info);
    case Step::health: return send(Request::health);
    case Step::boot: return send(Request::reset);
    case Step::rates: return send(Request::sample_rates);
    case Step::scan: return send(express_ ? Request::express_scan : Request::scan);
    default: return ok();
  }
}

Status RplidarSession::send(Request request) {
  if (receiver_.is_scanning()) before_ += counts_of(receiver_.scan_statistics());
  receiver_.expect_answer();
  return link_.write(encode(request).view());
}

LineCounts RplidarSession::counts() const {
  LineCounts all = before_;
  if (receiver_.is_scanning()) all += counts_of(receiver_.scan_statistics());
  all.skipped_bytes += receiver_.skipped_bytes();
  return all;
}

Result<bool> RplidarSession::advance(TimePoint now) {
  if (Status read = this->read(now, {}); !read.ok()) return read.error();
  if (Status gone_on = go_on(now); !gone_on.ok()) return gone_on.error();
  return step_ == Step::done;
}

Status RplidarSession::receive(TimePoint now, const Take& take) {
  if (Status read = this->read(now, take); !read.ok()) return read;
  return go_on(now);
}

// Each byte is heard alone, so that it is known when it came.
Status RplidarSession::read(TimePoint now, const Take& take) {
  std::array<std::uint8_t, 1024> bytes{};
  for (;;) {
    const Result<std::size_t> count = link_.read(bytes);
    if (!count) return count.error();
    if (*count == 0) return ok();
    arrivals_.note(heard_bytes_ + *count, now, link_.byte_time());
    for (std::size_t i = 0; i < *count; ++i) {
      const TimePoint came = arrivals_.of(heard_bytes_++) + from_seconds(link_.byte_time());
      place_in_capsule_ = 0;
      receiver_.feed({&bytes[i], 1}, [&](const Event& event) { hear(event, came, take); });
    }
    if (heard_bytes_ > kCapsuleSize) arrivals_.forget(heard_bytes_ - kCapsuleSize);
  }
}

void RplidarSession::hear(const Event& event, TimePoint now, const Take& take) {
  if (const auto* const point = std::get_if<Point>(&event)) return hear_point(*point, now, take);
  if (const auto* const info = std::get_if<DeviceInfo>(&event)) {
    answered_ = step_ == Step::info;
    info_ = *info;
  } else if (const auto* const health = std::get_if<Health>(&event)) {
    answered_ = step_ == Step::health;
    health_ = *health;
  } else if (const auto* const rates = std::get_if<SampleRates>(&event)) {
    answered_ = has_rates_ = step_ == Step::rates;
    if (rates->scan > 0.0 && rates->express_scan > 0.0) rates_ = *rates;
  } else {
    answered_ = step_ == Step::scan;
  }
}

void RplidarSession::hear_point(const Point& point, TimePoint now, const Take& take) {
  if (step_ != Step::spin && step_ != Step::flow && step_ != Step::scan) return;
  step_ = Step::flow;
  deadline_ = kForever;
  sent_ = arrivals_.of(heard_bytes_ - (express_ ? kCapsuleSize : kNodeSize));
  if (take) take(point, now - age_of_point());
  ++place_in_capsule_;
}

// A node is handed out when the next one has come. The points of a capsule come with the next one, which was sent when its own last
// point was measured.
Duration RplidarSession::age_of_point() const {
  if (!express_) return from_seconds(rates_.scan + kNodeSize * link_.byte_time());
  const auto points = static_cast<double>(2 * static_cast<int>(kCapsulePoints) - place_in_capsule_);
  return from_seconds(points * rates_.express_scan + kCapsuleSize * link_.byte_time());
}

Status RplidarSession::go_on(TimePoint now) {
  if (answered_) return take_answer(now);
  return now >= deadline_ ? give_up(now) : ok();
}

Status RplidarSession::take_answer(TimePoint now) {
  answered_ = false;
  switch (step_) {
    case Step::info: return say(Step::health, now);
    case Step::health: return take_health(now);
    case Step::rates: return choose(now);
    case Step::scan: return say(Step::spin, now);
    default: return ok();
  }
}

Status RplidarSession::take_health(TimePoint now) {
  if (health_.state != Health::State::error) return say(Step::rates, now);
  if (!std::exchange(was_reset_, true)) return say(Step::boot, now);
  char number[8];
  std::snprintf(number, sizeof number, "%04x", static_cast<unsigned>(health_.error));
  return fail(
      Code::failed_precondition,
      "the laser at " + link_.name() + " reports error " + number +
          " and still does after a reset: it has stopped to protect itself. Let its head turn freely, "
          "unplug it and plug it in again; if the error stays, it is broken");
}

// A firmware that does not tell its sample rates is older than express scans.
Status RplidarSession::choose(TimePoint now) {
  express_ = mode_ == ScanMode::express || (mode_ == ScanMode::automatic && has_rates_);
  return say(Step::done, now);
}

// Nothing has answered in time.
Status RplidarSession::give_up(TimePoint now) {
  switch (step_) {
    case Step::quiet: link_.discard_input(); return say(Step::info, now);
    case Step::hush: link_.discard_input(); return say(Step::scan, now);
    case Step::boot: return say(Step::quiet, now);
    case Step::spin:
      return fail(
          Code::deadline_exceeded,
          "the laser at " + link_.name() +
              " is told to scan and sends no points: does its head turn? If not, are the three wires of "
              "its motor connected, has its adapter 5 V, and does the adapter carry DTR?");
    default: break;
  }
  if (tries_ < kTries) return say_again(now);
  if (step_ == Step::rates) return choose(now);
  if (step_ == Step::scan && express_) return refuse_express(now);
  if (step_ == Step::info) return nobody();
  return fail(Code::deadline_exceeded,
              "the laser at " + link_.name() +
                  " answered first and then did not; is its cable loose, or another program talking to it?");
}

Status RplidarSession::refuse_express(TimePoint now) {
  if (mode_ == ScanMode::express)
    return fail(Code::failed_precondition, "the laser at " + link_.name() +
                                               " does not begin an express scan, which its firmware may not "
                                               "know; write mode=\"standard\" or mode=\"auto\"");
  express_ = false;
  return say(Step::scan, now);
}

Error RplidarSession::nobody() const {
  const std::string where = link_.name() + " at " + std::to_string(kBaud) + " baud";
  if (heard_bytes_ > 0)
    return fail(Code::not_found,
                "bytes come from " + where +
                    ", but no answer of an RPLIDAR A1: is it another device, or another RPLIDAR? An A3 or S1 "
                    "has 256000 baud. Does the cable only echo what it is sent?");
  return fail(Code::not_found,
              "no RPLIDAR answers at " + where +
                  "; is it plugged in, does its green lamp shine, and is this its serial port?");
}

}  // namespace orca::hw::rplidar
