// SPDX-License-Identifier: LGPL-3.0-or-later
#include "orca/hw/link/tcp_listener.hpp"

#include <arpa/inet.h>
#include <netinet/in.h>
#include <netinet/tcp.h>
#include <sys/socket.h>

#include <array>
#include <cerrno>
#include <cstring>
#include <utility>

#include "orca/base/exhaustion.hpp"
#include "orca/base/text.hpp"

namespace orca::hw::link {
namespace {

constexpr int kBacklog = 8;

Error cannot_listen(int reason, const std::string& address, std::uint16_t port) {
  const std::string number = std::to_string(port);
  const std::string start = "cannot listen at " + address + ":" + number + ": ";
  switch (reason) {
    case EADDRINUSE:
      return fail(Code::already_exists, start + "another program has the port; \"ss -ltnp 'sport = :" +
                                            number + "'\" shows which: stop it, or choose another port");
    case EACCES:
      return fail(Code::failed_precondition,
                  start + "ports below 1024 belong to the system; choose one from 1024 to 65535");
    case EADDRNOTAVAIL:
      return fail(Code::not_found,
                  start +
                      "this machine does not have that address; \"ip address\" shows those it "
                      "has, 0.0.0.0 stands for all of them");
    default: return fail(Code::unavailable, start + std::strerror(reason));
  }
}

std::string peer_of(const Descriptor& socket) {
  sockaddr_in peer{};
  socklen_t size = sizeof peer;
  (void)getpeername(socket.number(), reinterpret_cast<sockaddr*>(&peer), &size);
  std::array<char, INET_ADDRSTRLEN> text{};
  (void)inet_ntop(AF_INET, &peer.sin_addr, text.data(), text.size());
  return std::string(text.data()) + ":" + std::to_string(ntohs(peer.sin_port));
}

}  // namespace

Status TcpListener::open(const std::string& address, std::uint16_t port) {
  close();
  sockaddr_in place{};
  place.sin_family = AF_INET;
  place.sin_port = htons(port);
  if (inet_pton(AF_INET, address.c_str(), &place.sin_addr) != 1)
    return fail(Code::invalid_argument, in_quotes(printable(address)) +
                                            " is no IPv4 address; write 127.0.0.1 for clients on this "
                                            "machine, 0.0.0.0 for others, too");
  Descriptor socket(::socket(AF_INET, SOCK_STREAM | SOCK_NONBLOCK | SOCK_CLOEXEC, 0));
  if (!socket) throw_if_exhausted(errno);
  // Or the connections of an earlier run would keep the port for a minute.
  const int on = 1;
  (void)setsockopt(socket.number(), SOL_SOCKET, SO_REUSEADDR, &on, sizeof on);
  socklen_t size = sizeof place;
  if (!socket || bind(socket.number(), reinterpret_cast<const sockaddr*>(&place), size) != 0 ||
      listen(socket.number(), kBacklog) != 0 ||
      getsockname(socket.number(), reinterpret_cast<sockaddr*>(&place), &size) != 0)
    return cannot_listen(errno, address, port);
  address_ = address;
  port_ = ntohs(place.sin_port);
  socket_ = std::move(socket);
  return ok();
}

std::string TcpListener::name() const { return "tcp:" + address_ + ":" + std::to_string(port_); }

std::optional<TcpClient> TcpListener::accept() {
  Descriptor socket(accept4(socket_.number(), nullptr, nullptr, SOCK_NONBLOCK | SOCK_CLOEXEC));
  if (!socket) return std::nullopt;
  const int on = 1;
  (void)setsockopt(socket.number(), IPPROTO_TCP, TCP_NODELAY, &on, sizeof on);
  std::string peer = peer_of(socket);
  return TcpClient{std::move(socket), std::move(peer)};
}

}  // namespace orca::hw::link
