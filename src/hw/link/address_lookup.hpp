// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <sys/socket.h>

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "orca/base/result.hpp"

namespace orca::hw::link {

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
