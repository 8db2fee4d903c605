// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <cstdint>
#include <memory>
#include <mutex>
#include <optional>
#include <vector>

#include "orca/base/mutex.hpp"
#include "orca/patterns/endpoints/push_server_endpoint.hpp"
#include "outbox.hpp"
#include "participant.hpp"

namespace orca::dds {

/// The topic on which a Push port publishes: each object is written once, for all edges that are due.
///
/// Thread contract: reserve(), release() and use() before the component runs or after; the rest with the lock of the
/// port's endpoint held.
class Publication final : public PushOutlet {
 public:
  Publication(Outbox& outbox, std::shared_ptr<TopicWriter> writer)
      : outbox_(outbox), writer_(std::move(writer)) {}

  /// Returns a bit for an edge; nothing if all are taken.
  [[nodiscard]] std::optional<std::uint64_t> reserve();
  void release(std::uint64_t bit) { taken_ &= ~bit; }
  /// Writes with another writer from now on.
  void use(std::shared_ptr<TopicWriter> writer) { writer_ = std::move(writer); }

  /// Begins a time from which on a subscription uses the topic.
  [[nodiscard]] std::uint32_t begin_epoch() { return ++epoch_; }

  /// Adds an object for which an edge is due.
  /// @param bit  of the edge; 0: the edge gets it in another way, and only shall see that the topic works.
  /// @return false if too much waits to be written; the object is then not added.
  bool add(const ObjectRef& object, std::uint64_t bit);
  /// Writes the object that was added.
  void flush() override;

 private:
  Outbox& outbox_;
  std::shared_ptr<TopicWriter> writer_;
  std::uint64_t taken_ = 0;
  std::uint32_t epoch_ = 0;
  ObjectRef pending_;
  std::uint64_t due_ = 0;  // edges
};

/// Whoever gets the samples of a topic.
///
/// Thread contract: called by a thread of DDS: must not block.
class SampleSink {
 public:
  virtual ~SampleSink() = default;
  /// @param missed  samples that were lost before this one.
  virtual void take_sample(Sample sample, std::uint64_t missed) = 0;
};

/// The reader of a topic, for all edges of this process that get objects from it.
///
/// Thread contract: any thread.
class Subscription {
 public:
  /// Begins to receive.
  /// @errors  as Participant::make_reader().
  Status open(Participant& participant, const TopicOptions& topic);

  void add(SampleSink& sink);
  /// Removes a sink, which is not called afterwards.
  void remove(SampleSink& sink);

 private:
  void take(Sample sample);
  std::uint64_t missed_before(const Sample& sample) ORCA_REQUIRES(mutex_);

  Mutex mutex_;
  std::vector<SampleSink*> sinks_ ORCA_GUARDED_BY(mutex_);
  Origin origin_ ORCA_GUARDED_BY(mutex_){};
  std::uint64_t last_ ORCA_GUARDED_BY(mutex_) = 0;  // sequence number from that origin

  std::unique_ptr<TopicReader> reader_;  // the last member: its callback uses the others
};

}  // namespace orca::dds
