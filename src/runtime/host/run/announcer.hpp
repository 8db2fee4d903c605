// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <cstdint>
#include <mutex>
#include <vector>

#include "orca/component/host.hpp"
#include "orca/hw/scene.hpp"

namespace orca::host {

/// Writes what the user of the system wants to know on stdout, one line each, at once (DESIGN 15).
///
/// Thread contract: any strand.
class Announcer {
 public:
  /// @param start  of the run: the times printed count from it.
  explicit Announcer(TimePoint start) : start_(start) {}

  void announce(const Announcement& announcement);
  static void print_trace_hash(std::uint64_t hash);

  /// Adds arrivals to a picture.
  void draw(Scene& scene) const;

 private:
  const TimePoint start_;
  mutable std::mutex mutex_;
  std::vector<Announcement> said_;
};

}  // namespace orca::host
