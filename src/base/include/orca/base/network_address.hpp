// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <chrono>
#include <string>

#include "orca/base/result.hpp"
#include "orca/base/time.hpp"

namespace orca {

/// How long a process that begins waits for its network, which may be switched on with the machine, or be cut for a moment.
inline constexpr Duration kNetworkPatience = std::chrono::seconds(5);

/// Returns the IPv4 address under which this machine is to be reached, as a text.
/// @param interface  name of its network interface; empty: `address` decides.
/// @param address    its address or host name; empty, too: any will do, and the result is empty.
/// @param patience   longest wait [s] for the interface to be connected.
/// @errors  unavailable if the interface is not there, has no address or is not connected, if the host is not known, or if
///          the address is another machine's.
/// @thread  any. It may wait for a name server, too.
[[nodiscard]] Result<std::string> own_address(const std::string& interface, const std::string& address,
                                              Duration patience = Duration{0});

/// Returns the IPv4 address of a host name, or of such an address itself, as a text.
/// @errors  unavailable if there is none.
/// @thread  any. It may wait for a name server.
[[nodiscard]] Result<std::string> address_of_host(const std::string& host);

}  // namespace orca
