// SPDX-License-Identifier: LGPL-3.0-or-later
#include "orca/hw/line_driver.hpp"

#include <algorithm>
#include <chrono>
#include <utility>

#include "orca/hw/link/byte_log.hpp"
#include "orca/hw/link/logged_link.hpp"
#include "orca/hw/link/make_link.hpp"

namespace orca::hw {
namespace {

constexpr Duration kUnwoken = std::chrono::milliseconds(5);  // to the next look, if a line wakes nobody

}  // namespace

LineDriver::LineDriver(HardwareHost& host, const std::string& usual, const link::Line& first)
    : HardwareContainer(host),
      device_(*this, "device", usual,
              {.text = "Its line: a serial device (" + usual +
                       ", or a name in /dev/serial/by-id), tcp:HOST:PORT, or emulated:NAME for the "
                       "emulation of that name."}),
      first_(first) {}

std::vector<HardwareFault> LineDriver::prepare_line() {
  auto made = link::make_link(*device_);
  if (!made) return {{"device", made.error().message}};
  line_ = std::move(made).value();
  set_line_name(*device_);
  return {};
}

void LineDriver::log_connected(const std::string& device, std::uint32_t rate) const {
  const std::string at = has_rate() && rate != 0 ? " at " + std::to_string(rate) + " baud" : "";
  host().write_log(log::Level::info, "connected to " + device + at);
}

Status LineDriver::open() {
  if (Status made = make_line(); !made.ok()) return made;
  const Result<link::Opening> opening = line_->open();
  if (!opening) return opening.error();
  is_open_ = *opening == link::Opening::done;
  if (!is_open_) return ok();
  rings_ = line_->ring_at_input([this] { wake(); });
  session_ = &session();
  return session_->begin(host().now());
}

// A graph that is only checked has no clock and writes no file, so the line is made when it is opened for the first time.
Status LineDriver::make_line() {
  if (is_made_) return ok();
  const auto now = [this] { return host().now(); };
  auto made =
      link::make_link(*device_, {.line = first_, .now = now, .is_virtual = host().executive().is_virtual()});
  if (!made) return made.error();
  std::unique_ptr<link::ByteLink> line = std::move(made).value();
  if (!byte_log_->empty()) {
    auto log = link::ByteLog::create({.path = *byte_log_, .now = now}, line->name());
    if (!log) return log.error();
    line = std::make_unique<link::LoggedLink>(std::move(line), std::move(log).value());
  }
  line_ = std::move(line);
  is_made_ = true;
  return ok();
}

Result<bool> LineDriver::probe() {
  if (!is_open_) {
    if (Status opened = open(); !opened.ok()) return opened.error();
    return false;
  }
  Result<bool> done = session_->advance(host().now());
  if (!done || !*done) return done;
  if (Status met = meet(); !met.ok()) return met.error();
  return true;
}

void LineDriver::close() {
  if (is_open_) take_leave();
  line_->close();
  is_open_ = false;
}

TimePoint LineDriver::next_poll() const {
  if (!is_open_) return host().now();
  const bool works = state() == HardwareState::ready || state() == HardwareState::active;
  const TimePoint next = works ? next_turn() : next_step();
  const bool is_woken = rings_ || descriptor() >= 0;
  return is_woken ? next : std::min(next, host().now() + kUnwoken);
}

}  // namespace orca::hw
