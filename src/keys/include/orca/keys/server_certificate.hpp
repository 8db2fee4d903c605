// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "orca/base/result.hpp"

namespace orca::keys {

/// The certificate by which a server of TLS proves who it is. A plain value; `key` is secret.
struct ServerCertificate {
  std::string chain;  ///< PEM: its own certificate, and those that vouch for it.
  std::string key;    ///< PEM.
  std::vector<std::string>
      names;  ///< Hosts as addresses of pages write them: "robot", "*.lab.org", "10.0.0.7", "[fd00::7]".
  std::string fingerprint;  ///< SHA-256 of its own certificate as browsers show it: "3F:A0:...".
};

/// The name of such a file in its folder.
inline constexpr const char* kServerCertificateFile = "certificate.pem";

/// Reads a certificate and its key from a file of PEM that only this user can read, and proves that they belong together and are
/// good now.
/// @param now  [s since 1970-01-01 UTC].
/// @errors  not_found or unavailable if the file cannot be used; data_loss if it has no such things; failed_precondition if the
///          time of the certificate has not begun or has ended.
[[nodiscard]] Result<ServerCertificate> read_server_certificate(const std::string& file, std::int64_t now);

/// Returns the certificate that this user's servers have made for themselves; makes it if there is none, if it ends within 30
/// days, or if it lacks one of the names. It vouches for itself, so people must compare its fingerprint.
/// @param folder  for it; made if necessary.
/// @param names   as ServerCertificate has them.
/// @errors  unavailable or data_loss, with what to do.
[[nodiscard]] Result<ServerCertificate> own_server_certificate(const std::string& folder,
                                                               const std::vector<std::string>& names,
                                                               std::int64_t now);

}  // namespace orca::keys
