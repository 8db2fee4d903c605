// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <mutex>
#include <string>
#include <vector>

#include "orca/host/alarm_store.hpp"
#include "orca/idl/system.hpp"

namespace orca::host {

/// The alarms of the whole system, as components hear of them that pass them on.
///
/// Thread contract: any thread.
class AlarmNews {
 public:
  static constexpr std::size_t kMostNews = 1000;  ///< Older ones are forgotten.

  /// Takes an alarm that was raised or cleared.
  /// @param process  of its source; empty: this process, or not one alone.
  void add(const idl::Alarm& alarm, const std::string& process);
  /// Forgets an alarm that was acknowledged.
  /// @param process  of its source, this one, too.
  void acknowledge(const std::string& kind, const std::string& source, const std::string& process);

  /// Returns what was added since the last call with the same `position`, and moves it on.
  /// @param position  of one listener; 0: it hears first what was added before and is still there.
  [[nodiscard]] std::vector<idl::Alarm> since(std::uint64_t& position) const;
  /// Returns the alarms that nobody has acknowledged yet, in the order in which they were raised first.
  [[nodiscard]] std::vector<idl::Alarm> kept() const;

 private:
  mutable std::mutex mutex_;
  AlarmStore store_;
  std::deque<idl::Alarm> news_;
  std::uint64_t forgotten_ = 0;  // number of news before the first in news_
};

}  // namespace orca::host
