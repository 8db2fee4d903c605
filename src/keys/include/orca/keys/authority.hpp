// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <chrono>
#include <string>
#include <vector>

#include "orca/base/result.hpp"
#include "orca/keys/permit.hpp"

namespace orca::keys {

/// The folder of the authority, in that of the system's keys: its private key and its list of certificates. No machine needs it to run.
inline constexpr const char* kAuthorityFolder = "+authority";

/// When new certificates begin and end.
struct Validity {
  std::chrono::system_clock::time_point from;
  std::chrono::system_clock::time_point until;
};

/// Makes the keys of a system: an authority, and for each machine a folder (orca/base/files/key_folder.hpp) with a key, a
/// certificate and permissions for each of its processes. Keys have mode 0600, folders 0700.
/// @param folder   of the system; made if necessary.
/// @errors  already_exists if it has an authority; unavailable if files cannot be written.
[[nodiscard]] Status make_keys(const std::string& folder, const std::vector<Permit>& permits,
                               const Validity& validity);

/// Makes new keys, certificates and permissions by the authority that is there, for all processes. Former certificates are good
/// until they end.
/// @errors  not_found if there is no authority; those of make_keys().
[[nodiscard]] Status renew_keys(const std::string& folder, const std::vector<Permit>& permits,
                                const Validity& validity);

/// Revokes all certificates of a process or machine, and makes new ones for those of its processes that have a permit.
/// @param name  of the machine, or of the process.
/// @return what was revoked: "process brain", each once.
/// @errors  not_found if no certificate is the name's; those of renew_keys().
[[nodiscard]] Result<std::vector<std::string>> revoke_keys(const std::string& folder, const std::string& name,
                                                           const std::vector<Permit>& permits,
                                                           const Validity& validity);

}  // namespace orca::keys
