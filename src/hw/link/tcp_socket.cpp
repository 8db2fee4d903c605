// SPDX-License-Identifier: LGPL-3.0-or-later
#include "tcp_socket.hpp"

#include <linux/sockios.h>
#include <netinet/in.h>
#include <netinet/tcp.h>
#include <sys/ioctl.h>
#include <sys/socket.h>

namespace orca::hw::link {
namespace {

void set_number(int socket, int level, int option, int value) {
  (void)setsockopt(socket, level, option, &value, sizeof value);
}

constexpr int kSendBuffer = 16384;  // [bytes]

}  // namespace

void keep_fresh(int socket) {
  set_number(socket, SOL_SOCKET, SO_SNDBUF, kSendBuffer);
  set_number(socket, IPPROTO_TCP, TCP_NODELAY, 1);
  set_number(socket, SOL_SOCKET, SO_KEEPALIVE, 1);
  set_number(socket, IPPROTO_TCP, TCP_KEEPIDLE, 2);   // [s]
  set_number(socket, IPPROTO_TCP, TCP_KEEPINTVL, 1);  // [s]
  set_number(socket, IPPROTO_TCP, TCP_KEEPCNT, 3);
  set_number(socket, IPPROTO_TCP, TCP_USER_TIMEOUT, 5000);  // [ms]
}

std::size_t unsent_bytes(int socket) {
  int unsent = 0;
  if (socket < 0 || ioctl(socket, SIOCOUTQNSD, &unsent) != 0 || unsent < 0) return 0;
  return static_cast<std::size_t>(unsent);
}

std::string with_port(const std::string& address, std::uint16_t port) {
  const bool v6 = address.find(':') != std::string::npos;
  return (v6 ? "[" + address + "]" : address) + ":" + std::to_string(port);
}

}  // namespace orca::hw::link
