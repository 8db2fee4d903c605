// SPDX-License-Identifier: LGPL-3.0-or-later
#include "connection.hpp"

#include <arpa/inet.h>
#include <netinet/in.h>
#include <netinet/tcp.h>
#include <sys/socket.h>

#include <array>
#include <cerrno>
#include <cstring>
#include <utility>

namespace orca::player_server {
namespace {

constexpr int kBacklog = 8;

// Returns the address of one end of a connection.
template <class Ask>
sockaddr_in end_of(const Descriptor& socket, Ask ask) {
  sockaddr_in end{};
  socklen_t size = sizeof end;
  (void)ask(socket.number(), reinterpret_cast<sockaddr*>(&end), &size);
  return end;
}

// Player writes an IPv4 address as the number whose bytes in memory are those of the address in network order on a PC.
hw::player::Address own_end(const Descriptor& socket) {
  const sockaddr_in end = end_of(socket, getsockname);
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

Status Listener::open(const std::string& address, std::uint16_t port) {
  sockaddr_in place{};
  place.sin_family = AF_INET;
  place.sin_port = htons(port);
  if (inet_pton(AF_INET, address.c_str(), &place.sin_addr) != 1)
    return fail(Code::invalid_argument, address +
                                            " is no IPv4 address; write 127.0.0.1 for clients on this "
                                            "machine, 0.0.0.0 for others, too");
  Descriptor socket(::socket(AF_INET, SOCK_STREAM | SOCK_NONBLOCK | SOCK_CLOEXEC, 0));
  const int on = 1;
  (void)setsockopt(socket.number(), SOL_SOCKET, SO_REUSEADDR, &on, sizeof on);
  if (!socket || bind(socket.number(), reinterpret_cast<const sockaddr*>(&place), sizeof place) != 0 ||
      listen(socket.number(), kBacklog) != 0) {
    const int reason = errno;
    return fail(reason == EADDRINUSE ? Code::already_exists : Code::unavailable,
                "cannot listen at " + address + ":" + std::to_string(port) + ": " + std::strerror(reason) +
                    "; does another Player server run? Then choose another port");
  }
  port_ = ntohs(end_of(socket, getsockname).sin_port);
  socket_ = std::move(socket);
  return ok();
}

std::unique_ptr<Connection> Listener::accept(const RobotFace& face) {
  Descriptor socket(accept4(socket_.number(), nullptr, nullptr, SOCK_NONBLOCK | SOCK_CLOEXEC));
  if (!socket) return nullptr;
  const int on = 1;
  (void)setsockopt(socket.number(), IPPROTO_TCP, TCP_NODELAY, &on, sizeof on);
  const sockaddr_in peer = end_of(socket, getpeername);
  std::array<char, INET_ADDRSTRLEN> text{};
  (void)inet_ntop(AF_INET, &peer.sin_addr, text.data(), text.size());
  const std::string name = std::string(text.data()) + ":" + std::to_string(ntohs(peer.sin_port));
  return std::make_unique<Connection>(std::move(socket), face, name);
}

}  // namespace orca::player_server
