// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <cstdint>
#include <memory>
#include <mutex>
#include <vector>

#include "participant.hpp"

namespace orca::dds {

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
  std::uint64_t missed_before(const Sample& sample);

  std::mutex mutex_;
  // Below: guarded by mutex_.
  std::vector<SampleSink*> sinks_;
  Origin origin_{};
  std::uint64_t last_ = 0;  // sequence number from that origin

  std::unique_ptr<TopicReader> reader_;  // the last member: its callback uses the others
};

}  // namespace orca::dds
