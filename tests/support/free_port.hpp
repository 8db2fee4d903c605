// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <catch2/catch.hpp>

#include <netinet/in.h>
#include <sys/socket.h>

#include <cstdint>

#include "orca/base/descriptor.hpp"

namespace orca::test {

/// Returns a TCP port of loopback at which nobody listens, for programs that must be told one. The system gives such ports at random
/// from tens of thousands, so two tests hardly get the same.
inline std::uint16_t free_port() {
  const Descriptor made(socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0));
  sockaddr_in place{};
  place.sin_family = AF_INET;
  place.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  socklen_t size = sizeof place;
  REQUIRE(bind(made.number(), reinterpret_cast<const sockaddr*>(&place), size) == 0);
  REQUIRE(getsockname(made.number(), reinterpret_cast<sockaddr*>(&place), &size) == 0);
  return ntohs(place.sin_port);
}

}  // namespace orca::test
