// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <atomic>
#include <functional>
#include <optional>
#include <string>
#include <thread>

#include "orca/base/result.hpp"
#include "orca/supervisor/system_facts.hpp"

namespace orca::supervisor {

/// The reading and checking of a graph on a thread of its own, since it loads plugins and takes its time.
///
/// Thread contract: made, asked and destroyed by one thread.
class SystemReading {
 public:
  /// @param read  is called on the reading's thread; nothing else uses it at that time.
  /// @param done  called once on that thread when the outcome is there.
  SystemReading(SystemReader read, GraphSource source, std::function<void()> done);
  /// Waits for the end of the reading.
  ~SystemReading() { thread_.join(); }
  SystemReading(const SystemReading&) = delete;
  SystemReading& operator=(const SystemReading&) = delete;

  [[nodiscard]] bool is_done() const { return done_.load(std::memory_order_acquire); }
  /// Returns what came of it. @pre  is_done().
  [[nodiscard]] Result<CheckedSystem>& outcome() { return *outcome_; }

 private:
  std::optional<Result<CheckedSystem>> outcome_;
  std::atomic<bool> done_{false};
  std::thread thread_;  // the last member: it uses the others
};

}  // namespace orca::supervisor
