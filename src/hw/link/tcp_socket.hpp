// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>

namespace orca::hw::link {

/// Lets each write go out at once, keeps few bytes that nobody takes, and has a peer that does not answer any more told as gone after
/// about 5 s: by default the system would keep megabytes of old commands for a device that is stuck, and wait hours for one
/// whose cable was pulled.
void keep_fresh(int socket);

/// Returns the bytes that the system has taken and not sent yet; 0 if it cannot tell.
[[nodiscard]] std::size_t unsent_bytes(int socket);

/// Returns ADDRESS:PORT, with brackets around an IPv6 address.
[[nodiscard]] std::string with_port(const std::string& address, std::uint16_t port);

}  // namespace orca::hw::link
