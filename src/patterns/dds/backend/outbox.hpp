// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <condition_variable>
#include <cstddef>
#include <functional>
#include <memory>
#include <thread>
#include <vector>

#include "orca/base/mutex.hpp"
#include "participant.hpp"

namespace orca::dds {

/// Something to be written: an object with its label, or a message.
struct Letter {
  std::shared_ptr<TopicWriter> to;
  ObjectRef object{};
  Label label{};
  std::vector<std::byte> message{};
  std::size_t size = 0;  ///< The encoded object's [bytes].
};

/// The thread that writes to DDS, since a write may wait for a lock or for the network and a component must not. How much
/// may wait here is limited by whoever posts.
///
/// A thread that waits for the answer to a few bytes anyway may write them itself, which saves it the hand-over.
///
/// Thread contract: post() from any thread; it does not block. write_here() from a thread that holds no lock which a
/// callback of DDS may want.
class Outbox {
 public:
  /// @param tick  is called every Line::kTick on the thread.
  explicit Outbox(std::function<void()> tick);
  /// As end().
  ~Outbox();
  Outbox(const Outbox&) = delete;
  Outbox& operator=(const Outbox&) = delete;

  /// @param by  caller: a call of write_here() follows, until which the letter waits; next: it waits for others, a tick at most.
  void post(Letter letter, By by = By::outbox);
  /// Writes what waits on this thread, if that is little and nobody else is writing; otherwise leaves it to the thread.
  void write_here();
  /// Writes what waits, and ends the thread. Letters posted afterwards are not written.
  void end();

 private:
  void work();
  bool wait(std::chrono::steady_clock::time_point until);
  void write_all();
  bool take_few() ORCA_REQUIRES(writing_);
  void take() ORCA_REQUIRES(writing_) ORCA_REQUIRES(mutex_);
  void write_taken() ORCA_REQUIRES(writing_);

  const std::function<void()> tick_;
  Mutex writing_;  // held by whoever writes; before mutex_
  std::vector<Letter> taken_ ORCA_GUARDED_BY(writing_);
  Mutex mutex_;
  std::condition_variable changed_;
  std::vector<Letter> letters_ ORCA_GUARDED_BY(mutex_);
  bool ending_ ORCA_GUARDED_BY(mutex_) = false;

  std::thread thread_;
};

}  // namespace orca::dds
