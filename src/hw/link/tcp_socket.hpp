// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <sys/socket.h>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "orca/base/result.hpp"

namespace orca::hw::link {

/// Lets each write go out at once, keeps few bytes that nobody takes, and has a peer that does not answer any more told as gone after
/// about 5 s: by default the system would keep megabytes of old commands for a device that is stuck, and wait hours for one
/// whose cable was pulled.
void keep_fresh(int socket);

/// Returns the bytes that the system has taken and not sent yet; 0 if it cannot tell.
[[nodiscard]] std::size_t unsent_bytes(int socket);

/// Returns ADDRESS:PORT, with brackets around an IPv6 address.
[[nodiscard]] std::string with_port(const std::string& address, std::uint16_t port);

struct Address {
  sockaddr_storage place{};
  socklen_t size = 0;
};

/// The search for the addresses of a host, IPv4 and IPv6. A name server may take many seconds, so a name is looked up on a
/// thread of its own, which nobody waits for. An address needs none.
///
/// Thread contract: not synchronised.
class AddressLookup {
 public:
  /// Begins the search.
  AddressLookup(const std::string& host, const std::string& port);
  /// Gives the search up.
  ~AddressLookup();
  AddressLookup(const AddressLookup&) = delete;
  AddressLookup& operator=(const AddressLookup&) = delete;

  /// Returns the addresses, at least one; nothing: not yet.
  /// @errors  not_found: there is no such host; unavailable: nobody can tell now.
  [[nodiscard]] Result<std::optional<std::vector<Address>>> ask() const;

 private:
  struct Search;
  const std::shared_ptr<Search> search_;  // shared with its thread, which may end later than this
};

}  // namespace orca::hw::link
