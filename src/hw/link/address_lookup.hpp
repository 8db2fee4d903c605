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

/// The search for the addresses of a host, IPv4 and IPv6, which may take a name server many seconds and is not waited for.
///
/// Thread contract: not synchronised.
class AddressLookup {
 public:
  /// Begins the search.
  /// @param port  as a decimal number.
  AddressLookup(const std::string& host, const std::string& port);
  /// Gives the search up.
  ~AddressLookup();
  AddressLookup(const AddressLookup&) = delete;
  AddressLookup& operator=(const AddressLookup&) = delete;

  /// Returns the addresses, at least one; nothing: not yet.
  /// @errors  not_found: there is no such host; unavailable: nobody can tell now.
  [[nodiscard]] Result<std::optional<std::vector<Address>>> ask();

 private:
  struct Request;
  std::unique_ptr<Request> request_;
};

}  // namespace orca::hw::link
