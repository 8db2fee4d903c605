// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <cstdint>
#include <deque>
#include <memory>
#include <mutex>
#include <optional>

#include "dds_end.hpp"
#include "orca/base/mutex.hpp"
#include "topic.hpp"

namespace orca::dds {

/// The server's end of a Push edge. Objects are first sent as frames, which always arrive, and written to the topic as well.
/// Once the client's end has heard the topic, it is informed that objects come through the topic alone from now on. An object
/// for whose place its publisher waits is always a frame.
///
/// Thread contract: as DdsEnd; objects are sent with the lock of the port's endpoint held.
class PublishingEnd final : public DdsEnd {
 public:
  /// @param bit  of the edge, reserved.
  PublishingEnd(EndPlace place, std::shared_ptr<Publication> publication, std::uint64_t bit)
      : DdsEnd(std::move(place)), publication_(std::move(publication)), bit_(bit) {}
  ~PublishingEnd() override;

  frames::Sent send(const frames::Frame& frame, frames::Loss loss = frames::Loss::never,
                    frames::Caller caller = frames::Caller::goes_on) override;
  void arrived(Parcel kind, std::span<const std::byte> contents) override;

 private:
  // The part of the edge that goes through the topic.
  struct Direct {
    std::uint64_t session;
    std::uint64_t subscription;
    friend bool operator==(const Direct&, const Direct&) = default;
  };

  frames::Sent publish(const frames::Frame& frame, frames::Loss loss);
  bool go_direct(const Direct& wanted);

  const std::shared_ptr<Publication> publication_;
  const std::uint64_t bit_;
  std::atomic<std::uint64_t> heard_in_{0};  // session of the line in which the client has heard the topic
  std::optional<Direct> direct_;
};

/// The client's end of a Push edge. It passes on the objects of the topic that are due for it, in the order in which they
/// were pushed, whether they came as frames or through the topic.
///
/// Thread contract: as DdsEnd and SampleSink.
class SubscribingEnd final : public DdsEnd, public SampleSink {
 public:
  SubscribingEnd(EndPlace place, std::shared_ptr<Subscription> subscription)
      : DdsEnd(std::move(place)), subscription_(std::move(subscription)) {}
  ~SubscribingEnd() override { SubscribingEnd::stop(); }

  void start(frames::FrameHandlers handlers) override;
  void stop() override;
  frames::Sent send(const frames::Frame& frame, frames::Loss loss = frames::Loss::never,
                    frames::Caller caller = frames::Caller::goes_on) override;
  void arrived(Parcel kind, std::span<const std::byte> contents) override;
  void line_joined(std::uint64_t session) override;

  void take_sample(Sample sample, std::uint64_t missed) override;

 private:
  // From which sample on the topic counts, and for which subscription.
  struct Direct {
    std::uint64_t subscription;
    std::uint64_t bit;
    std::uint32_t epoch;
  };
  struct Held {
    Sample sample;
    std::uint64_t missed;
  };

  void go_direct(std::span<const std::byte> contents);
  void note_grant(std::span<const std::byte> frame);
  void forget_direct();
  void report_heard();
  void hold(Sample sample, std::uint64_t missed) ORCA_REQUIRES(topic_mutex_);
  void drop_oldest_held() ORCA_REQUIRES(topic_mutex_);
  void pass_on(Sample sample, std::uint64_t missed) ORCA_REQUIRES(topic_mutex_);
  void report_missed(std::uint64_t missed) ORCA_REQUIRES(topic_mutex_);

  const std::shared_ptr<Subscription> subscription_;
  std::atomic<std::uint64_t> reported_in_{0};  // session of the line in which the server was informed
  Mutex topic_mutex_;
  std::optional<Direct> direct_ ORCA_GUARDED_BY(topic_mutex_);
  std::deque<Held> held_ ORCA_GUARDED_BY(topic_mutex_);  // came before it was known whether they count
  std::size_t held_bytes_ ORCA_GUARDED_BY(topic_mutex_) = 0;
  std::uint64_t multiple_ ORCA_GUARDED_BY(topic_mutex_) = 1;  // of the grant
};

}  // namespace orca::dds
