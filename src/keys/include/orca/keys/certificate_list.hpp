// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "orca/base/result.hpp"

namespace orca::keys {

/// A certificate that the authority of a system has issued. A plain value.
struct Certificate {
  std::string subject;         ///< Common name: 32 hexadecimal digits, different in each certificate.
  std::string machine;         ///< Empty: the graph declares none.
  std::string process;         ///< Name in the graph, or kPeersKeys.
  std::int64_t not_after = 0;  ///< Its last moment [s since 1970-01-01 UTC].
  bool revoked = false;

  friend bool operator==(const Certificate&, const Certificate&) = default;
};

/// All certificates of a system that may still be met. The authority signs the list, and each process believes only
/// those in it: so a certificate ends when the list says so.
struct CertificateList {
  std::uint64_t edition = 0;  ///< Grows with each change; a process takes no earlier list than it has.
  std::vector<Certificate> certificates;

  friend bool operator==(const CertificateList&, const CertificateList&) = default;
};

/// Returns the list as text, one certificate a line.
[[nodiscard]] std::string print(const CertificateList& list);

/// Reads what print() has written.
/// @errors  data_loss, with the line.
[[nodiscard]] Result<CertificateList> parse_certificates(std::string_view text);

}  // namespace orca::keys
