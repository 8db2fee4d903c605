// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "orca/supervisor/moment.hpp"

namespace orca::supervisor {

/// Notices that files were written or exchanged. A file counts as changed when it has stayed as it is for a while and nobody
/// has it open to write it, since whoever writes it may not be done before.
///
/// Thread contract: one thread.
class CodeWatch {
 public:
  /// Returns those of the files that have changed since an earlier call; each change once. A file that is new to the watch
  /// has not changed. To be called several times a second.
  [[nodiscard]] std::vector<std::string> changed(const std::set<std::string>& files, Moment now);

 private:
  using Identity =
      std::array<std::int64_t, 5>;  // device, inode, size, seconds and nanoseconds of the last change
  struct File {
    std::optional<Identity> known;
    std::optional<Identity> seen;  // at the last look
    Moment since{};                // it is like that
  };

  static std::optional<Identity> identity_of(const std::string& file);
  static bool has_changed(const std::string& name, File& file, const std::optional<Identity>& identity,
                          Moment now);

  std::map<std::string, File> files_;
};

}  // namespace orca::supervisor
