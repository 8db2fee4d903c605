// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <condition_variable>
#include <memory>
#include <mutex>
#include <thread>
#include <vector>

namespace orca::bytes {

class ByteWire;

/// A thread unknown to any executive that carries bytes along wires, as a kernel or a listener of shared
/// memory does.
///
/// Thread contract: any thread.
class Courier {
 public:
  Courier();
  ~Courier();
  Courier(const Courier&) = delete;
  Courier& operator=(const Courier&) = delete;

  /// Adds a wire to those whose bytes it carries, until the wire is closed.
  void serve(std::shared_ptr<ByteWire> wire);
  /// Reports that some wire has bytes to carry, or has room for them, or was closed.
  void notify();

 private:
  void work();
  [[nodiscard]] std::vector<std::shared_ptr<ByteWire>> open_wires();

  std::mutex mutex_;
  std::condition_variable changed_;
  // Below: guarded by mutex_.
  std::vector<std::shared_ptr<ByteWire>> wires_;
  bool notified_ = false;
  bool ending_ = false;

  std::thread thread_;  // the last member: it uses the others
};

}  // namespace orca::bytes
