// SPDX-License-Identifier: GPL-3.0-or-later
// Additional permission: LICENSES/Orca-plugin-exception.txt
#pragma once

// Boost.Asio 1.74 needs it and does not include it.
#include <utility>

#include <boost/asio/ip/address.hpp>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "orca/base/result.hpp"
#include "orca/keys/server_certificate.hpp"

namespace orca::view {

/// What --listen says. A plain value.
struct Listening {
  boost::asio::ip::address address;
  std::optional<std::uint16_t> port{};  ///< None: the usual one, or any that is free.
};

/// Reads "10.0.0.7", "10.0.0.7:8443", "::" or "[fd00::7]:8443".
/// @errors  invalid_argument with what would be right.
[[nodiscard]] Result<Listening> parse_listening(std::string_view text);

/// Returns by which names people reach this machine at an address, as keys::ServerCertificate has them: that address, or those of
/// all connected interfaces if it stands for all, and the machine's name.
[[nodiscard]] std::vector<std::string> names_at(const boost::asio::ip::address& address);

/// Returns the certificate in `certificate.pem` of a folder, or, without one, that of orcaview itself, which it keeps in this user's
/// folder of settings.
/// @param own  the folder.
/// @errors  with the file, and what to do.
[[nodiscard]] Result<keys::ServerCertificate> certificate_for(const Listening& listening,
                                                              const std::optional<std::string>& own);

}  // namespace orca::view
