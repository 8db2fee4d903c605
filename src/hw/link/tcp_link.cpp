// SPDX-License-Identifier: LGPL-3.0-or-later
#include "orca/hw/link/tcp_link.hpp"

#include <netinet/in.h>
#include <poll.h>
#include <sys/socket.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <optional>
#include <vector>

#include "orca/base/descriptor.hpp"
#include "orca/base/exhaustion.hpp"
#include "orca/base/steady_clock.hpp"
#include "orca/base/text.hpp"
#include "tcp_socket.hpp"

namespace orca::hw::link {
namespace {

constexpr Duration kBetweenTries = 50ms;

Error cannot_connect(int reason, std::uint16_t port) {
  const std::string why = std::strerror(reason);
  switch (reason) {
    case ECONNREFUSED:
      return fail(Code::unavailable, "the connection was refused: nothing listens on port " +
                                         std::to_string(port) + "; is the device server running?");
    case ETIMEDOUT:
      return fail(Code::deadline_exceeded,
                  "the host does not answer; is it switched on and in this network?");
    case EHOSTUNREACH:
    case ENETUNREACH:
      return fail(Code::unavailable, "the host cannot be reached (" + why + "); is the network cable in?");
    default: return fail(Code::unavailable, "cannot connect: " + why);
  }
}

}  // namespace

// A connection that is being made: the search for the host, then one address after the other.
class Connecting {
 public:
  explicit Connecting(const TcpOptions& options)
      : options_(options),
        lookup_(options.host, std::to_string(options.port)),
        end_(saturating_add(steady_now(), options.limit)) {}

  // Goes on; gives the connected socket, an empty one: not yet.
  [[nodiscard]] Result<Descriptor> go_on() {
    if (!addresses_) {
      Result<std::optional<std::vector<Address>>> found = lookup_.ask();
      if (!found) return found.error();
      if (!*found) return steady_now() < end_ ? Result<Descriptor>(Descriptor()) : too_late();
      addresses_ = std::move(**found);
    }
    for (;;) {
      if (!socket_ && next_ == addresses_->size()) return failure_;
      if (!socket_) begin(next_++);
      if (socket_ && is_connected()) return std::move(socket_);
      if (socket_) return Descriptor();
    }
  }

 private:
  // Begins with an address. Without a socket it has failed already.
  void begin(std::size_t index) {
    const Address& address = (*addresses_)[index];
    const auto left = static_cast<std::int64_t>(addresses_->size() - index);
    until_ = steady_now() + std::max(end_ - steady_now(), Duration{0}) / left;
    socket_ = Descriptor(socket(address.place.ss_family, SOCK_STREAM | SOCK_NONBLOCK | SOCK_CLOEXEC, 0));
    if (!socket_) throw_if_exhausted(errno);
    const auto* const place = reinterpret_cast<const sockaddr*>(&address.place);
    if (!socket_ || (connect(socket_.number(), place, address.size) != 0 && errno != EINPROGRESS))
      give_up(cannot_connect(errno, options_.port));
  }

  // Returns whether the socket is connected; if that has failed, there is none any more.
  bool is_connected() {
    pollfd asked{socket_.number(), POLLOUT, 0};
    if (poll(&asked, 1, 0) <= 0) {
      if (steady_now() >= until_) give_up(too_late());
      return false;
    }
    int reason = 0;
    socklen_t size = sizeof reason;
    if (getsockopt(socket_.number(), SOL_SOCKET, SO_ERROR, &reason, &size) != 0) reason = errno;
    if (reason != 0) give_up(cannot_connect(reason, options_.port));
    return reason == 0;
  }

  void give_up(Error why) {
    socket_.reset();
    failure_ = std::move(why);
  }

  [[nodiscard]] Error too_late() const {
    return fail(Code::deadline_exceeded, "timed out: no answer within " + seconds_text(options_.limit) +
                                             "; is the device switched on and in this network?");
  }

  const TcpOptions& options_;
  AddressLookup lookup_;
  const TimePoint end_;
  std::optional<std::vector<Address>> addresses_;
  std::size_t next_ = 0;  // of the addresses
  TimePoint until_;       // for the one that is tried now
  Descriptor socket_;
  Error failure_;  // of the one that was tried last
};

TcpLink::TcpLink(TcpOptions options)
    : StreamLink(Kind::socket, "the other end has gone: was it switched off, or its cable pulled?"),
      options_(std::move(options)) {}

TcpLink::~TcpLink() = default;

Result<Opening> TcpLink::open() {
  if (is_attached()) return Opening::done;
  if (!connecting_ && steady_now() < next_try_) return Opening::under_way;
  if (!connecting_) connecting_ = std::make_unique<Connecting>(options_);
  Result<Descriptor> socket = connecting_->go_on();
  if (socket && !*socket) return Opening::under_way;
  connecting_.reset();
  if (!socket) return fail_or_wait(socket.error());
  waits_since_.reset();
  keep_fresh(socket->number());
  attach(std::move(*socket));
  return Opening::done;
}

Result<Opening> TcpLink::fail_or_wait(const Error& why) {
  const TimePoint now = steady_now();
  if (!waits_since_) waits_since_ = now;
  if (why.code == Code::unavailable && now - *waits_since_ < options_.patience) {
    next_try_ = now + kBetweenTries;
    return Opening::under_way;
  }
  waits_since_.reset();
  return fail(why.code, why.message, name());
}

void TcpLink::close() {
  waits_since_.reset();
  next_try_ = {};
  connecting_.reset();
  discard_input();  // or the system cuts the connection, and the device loses what was written last
  detach();
}

std::string TcpLink::name() const { return "tcp:" + with_port(options_.host, options_.port); }

}  // namespace orca::hw::link
