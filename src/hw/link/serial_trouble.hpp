// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "orca/base/result.hpp"

namespace orca::hw::link {

/// The names that the system gives to serial adapters: by their make and number in by-id, by the socket they are in in
/// by-path. The names in by-id stay with an adapter, whatever /dev/ttyUSB number it gets when it is plugged in again.
///
/// Thread contract: immutable; each question looks at the file system anew.
class SerialPlaces {
 public:
  /// @param folder  where the system keeps by-id and by-path: /dev/serial.
  explicit SerialPlaces(std::string folder) : folder_(std::move(folder)) {}

  /// Returns the path of what a person has written: a path, or a name in by-id, by-path or /dev.
  [[nodiscard]] std::string path_of(const std::string& device) const;
  /// Returns the path in by-id of the adapter that `path` leads to; empty: it has none.
  [[nodiscard]] std::string identity_of(const std::string& path) const;
  /// Returns whether the path is one of these names, so that it leads to what its user means wherever that is now.
  [[nodiscard]] bool holds(const std::string& path) const { return path.starts_with(folder_ + "/"); }
  /// Returns the paths in by-id of all adapters that are plugged in, sorted.
  [[nodiscard]] std::vector<std::string> adapters() const;

 private:
  const std::string folder_;
};

/// Says why a serial device cannot be opened and what to do.
/// @param path    what was to be opened.
/// @param reason  errno of the attempt.
/// @param name    of the link, for messages.
[[nodiscard]] Error explain_refusal(const std::string& path, int reason, const SerialPlaces& places,
                                    const std::string& name);

}  // namespace orca::hw::link
