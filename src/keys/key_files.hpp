// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <string>

#include "crypto.hpp"
#include "orca/base/result.hpp"
#include "orca/keys/certificate_list.hpp"

namespace orca::keys {

/// Names of the files in a folder of keys.
inline constexpr const char* kAuthorityFile = "authority.pem";
inline constexpr const char* kAuthorityKeyFile = "authority.key";
inline constexpr const char* kGovernanceFile = "governance.p7s";
inline constexpr const char* kListFile = "certificates.p7s";
/// Those of a process; that of its key is key_file_name().
[[nodiscard]] std::string certificate_file(const std::string& process);
[[nodiscard]] std::string permissions_file(const std::string& process);

/// Makes a folder that is the user's alone, or proves that it is.
/// @errors  unavailable with the reason.
[[nodiscard]] Status make_own_folder(const std::string& path);
/// Proves that a folder belongs to this user and that nobody else may enter it (mode 0700).
/// @errors  not_found, unavailable with what to do.
[[nodiscard]] Status prove_own_folder(const std::string& path);

/// Reads a file that belongs to this user and that nobody else may read (mode 0600).
/// @errors  not_found, unavailable with what to do.
[[nodiscard]] Result<std::string> read_own(const std::string& path);
/// Writes a file with mode 0600, whole or not at all.
/// @errors  unavailable.
[[nodiscard]] Status write_own(const std::string& path, const std::string& contents);

/// Reads a list of certificates and proves it.
/// @errors  those of read_own(), signed_text() and parse_certificates(), with the file's path.
[[nodiscard]] Result<CertificateList> read_list(const std::string& path, X509& authority);

}  // namespace orca::keys
