// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <condition_variable>
#include <cstddef>
#include <functional>
#include <memory>
#include <mutex>
#include <thread>
#include <vector>

#include "participant.hpp"

namespace orca::dds {

/// Something to be written: an object with its label, or a message.
struct Letter {
  std::shared_ptr<TopicWriter> to;
  ObjectRef object{};
  Label label{};
  std::vector<std::byte> message{};
  std::size_t size = 0;  ///< Of the object, encoded [bytes].
};

/// The thread that writes to DDS, since a write may wait for a lock or for the network and a component must not. How much
/// may wait here is limited by whoever posts.
///
/// Thread contract: post() from any thread; it does not block.
class Outbox {
 public:
  /// @param tick  is called every Line::kTick on the thread.
  explicit Outbox(std::function<void()> tick);
  /// Writes what waits, and ends the thread.
  ~Outbox();
  Outbox(const Outbox&) = delete;
  Outbox& operator=(const Outbox&) = delete;

  void post(Letter letter);

 private:
  void work();
  bool wait(std::vector<Letter>& letters, std::chrono::steady_clock::time_point until);

  const std::function<void()> tick_;
  std::mutex mutex_;
  std::condition_variable changed_;
  // Below: guarded by mutex_.
  std::vector<Letter> letters_;
  bool ending_ = false;

  std::thread thread_;
};

}  // namespace orca::dds
