// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <atomic>
#include <condition_variable>
#include <cstddef>
#include <mutex>
#include <string>
#include <thread>

#include "orca/base/descriptor.hpp"

namespace orca::hw::link {

/// A text file that is written by a thread of its own, since a disk may take seconds and the strand of a device must not
/// wait for it. When the disk fails or is too slow it gives up, and says so once in the log.
///
/// Thread contract: one thread adds; is_writing() from any.
class LogWriter {
 public:
  /// @param file  open for writing.
  LogWriter(Descriptor file, std::string path);
  /// Waits until the disk has got what was added.
  ~LogWriter();
  LogWriter(const LogWriter&) = delete;
  LogWriter& operator=(const LogWriter&) = delete;

  /// Appends whole lines. It does not wait for the disk.
  void add(const std::string& lines);
  /// Returns whether it has not given up.
  [[nodiscard]] bool is_writing() const { return !given_up_.load(std::memory_order_relaxed); }

 private:
  void run();
  void write_all(const std::string& text);
  void give_up(const std::string& why);

  const Descriptor file_;
  const std::string path_;
  std::atomic<bool> given_up_{false};
  std::mutex mutex_;
  std::condition_variable changed_;
  std::string queue_;    // protected by mutex_
  bool ending_ = false;  // protected by mutex_
  std::thread thread_;   // last: it uses the others
};

}  // namespace orca::hw::link
