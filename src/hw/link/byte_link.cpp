// SPDX-License-Identifier: LGPL-3.0-or-later
#include "orca/hw/link/byte_link.hpp"

#include <chrono>
#include <thread>

#include "orca/base/text.hpp"

namespace orca::hw::link {
namespace {

constexpr std::chrono::milliseconds kPause{2};

}  // namespace

Status open_within(ByteLink& link, Duration limit) {
  const auto end = std::chrono::steady_clock::now() + limit;
  for (;;) {
    const Result<Opening> opened = link.open();
    if (!opened) return opened.error();
    if (*opened == Opening::done) return ok();
    if (std::chrono::steady_clock::now() >= end) break;
    std::this_thread::sleep_for(kPause);
  }
  link.close();
  return fail(Code::deadline_exceeded,
              "no answer within " + seconds_text(limit) + "; is the device switched on?", link.name());
}

Error not_open(const ByteLink& link) {
  return fail(Code::failed_precondition, "the link is not open; open() it first", link.name());
}

Error takes_no_more(const ByteLink& link, std::size_t waiting) {
  return fail(Code::deadline_exceeded,
              "the device takes no bytes: " + std::to_string(waiting) +
                  " wait already. Is it switched on, and does its cable need a handshake that nobody gives?",
              link.name());
}

Status check_size(const ByteLink& link, std::size_t bytes) {
  if (bytes <= kMostPending) return ok();
  return fail(Code::invalid_argument,
              "a write of " + std::to_string(bytes) + " bytes is too long; write at most " +
                  std::to_string(kMostPending) + " at once",
              link.name());
}

}  // namespace orca::hw::link
