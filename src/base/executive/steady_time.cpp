// SPDX-License-Identifier: LGPL-3.0-or-later
#include "steady_time.hpp"

namespace orca::detail {
namespace {

Duration epoch_offset() {
  static const Duration offset = std::chrono::system_clock::now().time_since_epoch() -
                                 std::chrono::steady_clock::now().time_since_epoch();
  return offset;
}

}  // namespace

TimePoint steady_now() {
  return TimePoint(std::chrono::steady_clock::now().time_since_epoch() + epoch_offset());
}

std::chrono::steady_clock::time_point to_steady(TimePoint time) {
  return std::chrono::steady_clock::time_point(time.time_since_epoch() - epoch_offset());
}

}  // namespace orca::detail
