// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <cstdint>
#include <mutex>

#include "orca/base/time.hpp"
#include "orca/hw/line_counts.hpp"
#include "orca/idl/hardware.hpp"

namespace orca::hw {

/// What has been counted on a device's line since the system was started, over all connections.
///
/// Thread contract: any.
class LineRecord {
 public:
  /// Notes that the line was opened: the driver counts anew.
  void opened();
  /// Notes that the device has answered.
  void answered();
  /// Notes what the driver has counted since the line was opened.
  void count(const LineCounts& counts);
  /// Notes how old a message of the device was when it was understood [s].
  void heard(Duration age);

  /// Fills in the counters.
  void fill(idl::DeviceStatistics& statistics) const;

 private:
  mutable std::mutex mutex_;
  LineCounts before_;  // of earlier connections
  LineCounts now_;     // of this one
  std::uint32_t connections_ = 0;
  std::uint64_t messages_ = 0;
  Duration ages_{0};  // of all messages together
  Duration oldest_{0};
};

}  // namespace orca::hw
