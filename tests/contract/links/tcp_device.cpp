// SPDX-License-Identifier: GPL-3.0-or-later
#include "tcp_device.hpp"

#include <netinet/in.h>
#include <sys/socket.h>

#include <cerrno>
#include <cstring>
#include <stdexcept>

namespace orca::test {
namespace {

constexpr int kBuffer = 8192;  // [bytes]

sockaddr_storage loopback(int family, socklen_t& size) {
  sockaddr_storage place{};
  place.ss_family = static_cast<sa_family_t>(family);
  if (family == AF_INET) {
    reinterpret_cast<sockaddr_in&>(place).sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    size = sizeof(sockaddr_in);
  } else {
    reinterpret_cast<sockaddr_in6&>(place).sin6_addr = in6addr_loopback;
    size = sizeof(sockaddr_in6);
  }
  return place;
}

}  // namespace

TcpDevice::TcpDevice(int family) : listener_(socket(family, SOCK_STREAM | SOCK_NONBLOCK | SOCK_CLOEXEC, 0)) {
  socklen_t size = 0;
  sockaddr_storage place = loopback(family, size);
  setsockopt(listener_.number(), SOL_SOCKET, SO_RCVBUF, &kBuffer, sizeof kBuffer);
  if (bind(listener_.number(), reinterpret_cast<const sockaddr*>(&place), size) != 0 ||
      listen(listener_.number(), 4) != 0 ||
      getsockname(listener_.number(), reinterpret_cast<sockaddr*>(&place), &size) != 0)
    throw std::runtime_error(std::string("cannot listen on loopback: ") + std::strerror(errno));
  port_ = ntohs(family == AF_INET ? reinterpret_cast<const sockaddr_in&>(place).sin_port
                                  : reinterpret_cast<const sockaddr_in6&>(place).sin6_port);
}

Result<hw::link::Opening> TcpDevice::open() {
  if (!peer_) peer_ = Descriptor(accept4(listener_.number(), nullptr, nullptr, SOCK_NONBLOCK | SOCK_CLOEXEC));
  return peer_ ? hw::link::Opening::done : hw::link::Opening::under_way;
}

void TcpDevice::close() { peer_.reset(); }

Result<std::size_t> TcpDevice::read(std::span<std::uint8_t> into) {
  const ssize_t count = recv(peer_.number(), into.data(), into.size(), 0);
  if (count > 0) return static_cast<std::size_t>(count);
  if (count < 0 && errno == EAGAIN) return 0;
  return fail(Code::unavailable, "the driver has gone", name());
}

Status TcpDevice::write(std::span<const std::uint8_t> bytes) {
  const ssize_t count = send(peer_.number(), bytes.data(), bytes.size(), MSG_NOSIGNAL);
  if (count == static_cast<ssize_t>(bytes.size())) return ok();
  // The tests read fast enough that nothing is ever taken in part.
  return fail(count < 0 && errno == EAGAIN ? Code::deadline_exceeded : Code::unavailable, "cannot send",
              name());
}

}  // namespace orca::test
