// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "orca/base/result.hpp"
#include "orca/keys/certificate_list.hpp"

namespace orca::keys {

/// The beginning of the GUIDs of a participant with a certificate: DDS Security derives 47 bits from the subject's name, and whoever
/// checks the certificate checks them (DDS Security 1.1, 9.3.3, table 52).
using Mark = std::array<std::uint8_t, 6>;

/// Returns the mark of a certificate.
/// @param subject  its common name.
[[nodiscard]] Mark mark_of(const std::string& subject);

/// The keys with which a process speaks in a secured system: proven when they are read, and watched while it runs.
///
/// Thread contract: one thread; files() any.
class KeyRing {
 public:
  /// Reads and proves the keys of a process: who owns them, who may read them, that the authority has signed them, that they
  /// belong together, are not revoked and have not ended.
  /// @param folder  of the machine (orca/base/files/key_folder.hpp).
  /// @param now     [s since 1970-01-01 UTC].
  /// @errors  not_found, unavailable, data_loss or failed_precondition; says what to do.
  [[nodiscard]] static Result<KeyRing> open(const std::string& folder, const std::string& process,
                                            std::int64_t now);

  /// Returns the properties that make a participant of DDS use the keys, by name.
  [[nodiscard]] const std::vector<std::pair<std::string, std::string>>& properties() const {
    return properties_;
  }

  /// Returns all certificates by their marks.
  [[nodiscard]] const std::map<Mark, Certificate>& known() const { return known_; }
  /// Returns the certificate of this process.
  [[nodiscard]] const Certificate& own() const { return own_; }

  /// Reads the list again if its file has changed.
  /// @return whether there is a new one.
  /// @errors  as open(); the former list stays.
  [[nodiscard]] Result<bool> look();

  /// Returns why this process may speak no longer; empty if it may.
  [[nodiscard]] std::string fault(std::int64_t now) const;

 private:
  KeyRing() = default;
  void take(CertificateList list);

  struct Proof;  // the authority's certificate
  std::shared_ptr<const Proof> proof_;
  std::string folder_;
  std::vector<std::pair<std::string, std::string>> properties_;
  Certificate own_;
  std::uint64_t edition_ = 0;
  std::int64_t changed_ = 0;  // when the file of the list was changed last [ns]
  std::map<Mark, Certificate> known_;
};

}  // namespace orca::keys
