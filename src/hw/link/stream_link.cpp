// SPDX-License-Identifier: LGPL-3.0-or-later
#include "orca/hw/link/stream_link.hpp"

#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>

#include "tcp_socket.hpp"

namespace orca::hw::link {
namespace {

constexpr int kNoReason = 0;

bool is_later(int reason) { return reason == EAGAIN || reason == EWOULDBLOCK || reason == EINTR; }

// A terminal whose device was unplugged gives EIO, ENXIO or ENODEV; the others are those of connections.
bool is_departure(int reason) {
  constexpr std::array kReasons{EIO,       ENXIO,        ENODEV,      EPIPE,   ECONNRESET,
                                ETIMEDOUT, EHOSTUNREACH, ENETUNREACH, ENETDOWN};
  return std::ranges::find(kReasons, reason) != kReasons.end();
}

}  // namespace

void StreamLink::attach(Descriptor descriptor) {
  waiting_.clear();
  descriptor_ = std::move(descriptor);
}

void StreamLink::detach() {
  waiting_.clear();
  descriptor_.reset();
}

Result<std::size_t> StreamLink::read(std::span<std::uint8_t> into) {
  if (!is_attached()) return not_open(*this);
  const Status sent = StreamLink::flush();
  if (into.empty()) return sent.ok() ? Result<std::size_t>(0) : sent.error();
  const ssize_t count = ::read(descriptor_.number(), into.data(), into.size());
  if (count > 0) return static_cast<std::size_t>(count);
  if (count == 0) return gone(kNoReason);  // a terminal has at least one byte or fails (VMIN 1)
  const int reason = errno;
  if (!is_later(reason)) return failed("read", reason);
  if (!sent.ok()) return sent.error();
  return 0;
}

Status StreamLink::write(std::span<const std::uint8_t> bytes) {
  if (!is_attached()) return not_open(*this);
  if (Status fits = check_size(*this, bytes.size()); !fits.ok()) return fits;
  if (Status sent = StreamLink::flush(); !sent.ok()) return sent;
  if (has_hung_up()) return gone(kNoReason);
  if (waiting_.size() + bytes.size() > kMostPending) return takes_no_more(*this, waiting_.size());
  waiting_.insert(waiting_.end(), bytes.begin(), bytes.end());
  return StreamLink::flush();
}

Status StreamLink::flush() {
  if (!is_attached()) return not_open(*this);
  std::size_t sent = 0;
  while (sent < waiting_.size()) {
    const std::ptrdiff_t count = send(std::span(waiting_).subspan(sent));
    const int reason = count < 0 ? errno : EAGAIN;
    if (count > 0) {
      sent += static_cast<std::size_t>(count);
    } else if (reason == EINTR) {
      continue;
    } else if (is_later(reason)) {
      break;
    } else {
      return failed("write", reason);
    }
  }
  waiting_.erase(waiting_.begin(), waiting_.begin() + static_cast<std::ptrdiff_t>(sent));
  return ok();
}

std::size_t StreamLink::pending() const {
  return waiting_.size() + (kind_ == Kind::socket ? unsent_bytes(descriptor_.number()) : 0);
}

void StreamLink::discard_input() {
  constexpr int kMostReads = 1024;  // a device that never pauses must not hold the strand
  std::array<std::uint8_t, 4096> dropped{};
  for (int i = 0; is_attached() && i < kMostReads; ++i)
    if (::read(descriptor_.number(), dropped.data(), dropped.size()) <= 0) return;
}

// A pseudo terminal takes bytes, and a connection takes some, when nobody can read them any more.
bool StreamLink::has_hung_up() const {
  const short end = static_cast<short>(POLLHUP | POLLERR | (kind_ == Kind::socket ? POLLRDHUP : 0));
  pollfd asked{descriptor_.number(), end, 0};
  return poll(&asked, 1, 0) > 0 && (asked.revents & end) != 0;
}

Error StreamLink::gone(int reason) const {
  const std::string why = reason == kNoReason ? "" : std::string(" (") + std::strerror(reason) + ")";
  return fail(Code::unavailable, gone_ + why, name());
}

Error StreamLink::failed(const char* act, int reason) const {
  if (is_departure(reason)) return gone(reason);
  return fail(Code::data_loss, std::string("cannot ") + act + ": " + std::strerror(reason), name());
}

std::ptrdiff_t StreamLink::send(std::span<const std::uint8_t> bytes) const {
  return kind_ == Kind::socket ? ::send(descriptor_.number(), bytes.data(), bytes.size(), MSG_NOSIGNAL)
                               : ::write(descriptor_.number(), bytes.data(), bytes.size());
}

}  // namespace orca::hw::link
