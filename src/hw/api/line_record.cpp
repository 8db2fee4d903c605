// SPDX-License-Identifier: LGPL-3.0-or-later
#include "line_record.hpp"

#include <algorithm>
#include <utility>

namespace orca::hw {

void LineRecord::opened() {
  const std::lock_guard lock(mutex_);
  before_ += std::exchange(now_, {});
}

void LineRecord::answered() {
  const std::lock_guard lock(mutex_);
  ++connections_;
}

void LineRecord::count(const LineCounts& counts) {
  const std::lock_guard lock(mutex_);
  now_ = counts;
}

void LineRecord::heard(Duration age) {
  const std::lock_guard lock(mutex_);
  ++messages_;
  ages_ += age;
  oldest_ = std::max(oldest_, age);
}

void LineRecord::fill(idl::DeviceStatistics& statistics) const {
  const std::lock_guard lock(mutex_);
  LineCounts all = before_;
  all += now_;
  statistics.frames(all.frames);
  statistics.bad_checksums(all.bad_checksums);
  statistics.skipped_bytes(all.skipped_bytes);
  statistics.resynchronisations(all.resynchronisations);
  statistics.connections(connections_);
  statistics.mean_latency(messages_ > 0 ? to_seconds(ages_) / static_cast<double>(messages_) : 0.0);
  statistics.max_latency(to_seconds(oldest_));
}

}  // namespace orca::hw
