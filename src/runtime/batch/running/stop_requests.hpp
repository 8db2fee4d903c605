// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <csignal>

namespace orca::batch {

/// SIGINT and SIGTERM as news instead of an end, as long as the object exists.
///
/// Thread contract: the main thread, while there is no other.
class StopRequests {
 public:
  StopRequests();
  ~StopRequests();
  StopRequests(const StopRequests&) = delete;
  StopRequests& operator=(const StopRequests&) = delete;

  /// The descriptor that is readable from the first request on.
  [[nodiscard]] int descriptor() const { return descriptor_; }
  /// Returns whether there was a request.
  [[nodiscard]] bool any() const;

 private:
  sigset_t before_{};
  int descriptor_ = -1;
};

}  // namespace orca::batch
