// SPDX-License-Identifier: LGPL-3.0-or-later
#include "connection.hpp"

#include <netinet/in.h>
#include <sys/socket.h>

#include <array>
#include <cerrno>
#include <utility>

namespace orca::player_server {
namespace {

// Player writes an IPv4 address as the number whose bytes in memory are those of the address in network order on a PC.
hw::player::Address own_end(const Descriptor& socket) {
  sockaddr_in end{};
  socklen_t size = sizeof end;
  (void)getsockname(socket.number(), reinterpret_cast<sockaddr*>(&end), &size);
  const std::uint32_t host = ntohl(end.sin_addr.s_addr);
  return {.host = __builtin_bswap32(host), .robot = ntohs(end.sin_port)};
}

bool is_later(int reason) { return reason == EAGAIN || reason == EWOULDBLOCK || reason == EINTR; }

Error gone() { return fail(Code::unavailable, "it has gone"); }

}  // namespace

Connection::Connection(Descriptor socket, const RobotFace& face, std::string peer)
    : socket_(std::move(socket)), peer_(std::move(peer)), session_(face, own_end(socket_)) {}

Status Connection::exchange(TimePoint now) {
  constexpr int kMostReads = 64;  // of one client at a time
  std::array<std::uint8_t, 4096> bytes{};
  for (int i = 0; i < kMostReads; ++i) {
    const ssize_t count = recv(socket_.number(), bytes.data(), bytes.size(), 0);
    if (count == 0) return gone();
    if (count < 0 && !is_later(errno)) return gone();
    if (count < 0) break;
    if (Status taken = session_.take({bytes.data(), static_cast<std::size_t>(count)}, now); !taken.ok())
      return taken;
  }
  return send();
}

Status Connection::send() {
  std::vector<std::uint8_t>& output = session_.output();
  std::size_t sent = 0;
  while (sent < output.size()) {
    const ssize_t count = ::send(socket_.number(), output.data() + sent, output.size() - sent, MSG_NOSIGNAL);
    if (count < 0 && !is_later(errno)) return gone();
    if (count <= 0) break;
    sent += static_cast<std::size_t>(count);
  }
  output.erase(output.begin(), output.begin() + static_cast<std::ptrdiff_t>(sent));
  return ok();
}

}  // namespace orca::player_server
