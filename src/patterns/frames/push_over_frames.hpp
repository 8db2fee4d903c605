// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>

#include "frame_end.hpp"
#include "orca/base/mutex.hpp"
#include "orca/patterns/endpoints/endpoint.hpp"
#include "orca/patterns/endpoints/push_link.hpp"

namespace orca::frames {

/// The client's end of a Push edge. It stands for the server's source.
///
/// Thread contract: as PushSource.
class PushSourceOverFrames final : public PushSource, public LinkEnd {
 public:
  /// @param type         what the objects are, or are derived from.
  /// @param path         of the server.
  /// @param base_period  of the server at present [s]; later ones come with what it grants.
  PushSourceOverFrames(std::unique_ptr<FrameEnd> end, const ObjectType& type, std::string path,
                       Duration base_period);
  ~PushSourceOverFrames() override { end_->stop(); }

  void attach(PushSink& sink, const UpdateRate& rate) override;
  void detach() override;
  void change(const UpdateRate& rate) override;
  void room() override;
  [[nodiscard]] Duration base_period() const override;
  [[nodiscard]] std::string path() const override { return path_; }

 private:
  // An object that did not fit in and for which its publisher waits.
  struct Held {
    ObjectRef object;
    std::uint64_t ticket;
  };

  Status receive(FrameReader& frame);
  Status receive_object(FrameReader& frame);
  Status receive_grant(FrameReader& frame);
  Status receive_give_up(FrameReader& frame);
  Status receive_loss(FrameReader& frame);
  void lose_server();
  void subscribe_again();
  void send_attach() ORCA_REQUIRES(mutex_);
  [[nodiscard]] bool is_current(const FrameReader& frame) const ORCA_REQUIRES(mutex_);
  void deliver(ObjectRef object, std::uint64_t ticket) ORCA_REQUIRES(mutex_);

  const ObjectType& type_;
  const std::string path_;

  mutable Mutex mutex_;
  PushSink* sink_ ORCA_GUARDED_BY(mutex_) = nullptr;  // null: not subscribed
  std::uint64_t subscription_ ORCA_GUARDED_BY(mutex_) =
      0;                                     // a count, so that objects of an earlier one are discarded
  UpdateRate rate_ ORCA_GUARDED_BY(mutex_);  // that was asked for last
  Duration base_period_ ORCA_GUARDED_BY(mutex_);
  std::optional<Held> held_ ORCA_GUARDED_BY(mutex_);  // only while subscribed

  const std::unique_ptr<FrameEnd> end_;  // the last member: its handlers use the others
};

/// The server's end of a Push edge. It stands for the client's sink. Where the edge's policy is `block`, a
/// publisher waits for each object until the client has taken it in, which costs a round trip.
///
/// Thread contract: as PushSink.
class PushSinkOverFrames final : public PushSink, public LinkEnd {
 public:
  PushSinkOverFrames(std::unique_ptr<FrameEnd> end, PushSource& source, const QueuePolicy& policy);
  ~PushSinkOverFrames() override;

  std::optional<Duration> deliver(ObjectRef&& object) override;
  void give_up(const ObjectRef& object) override;
  void granted(const UpdateGrant& grant) override;
  void lost(std::uint64_t objects) override;

 private:
  Status receive(FrameReader& frame);
  Status receive_rate(FrameReader& frame);
  Status receive_taken(FrameReader& frame);
  void lose_client();
  void push(const ObjectRef& object);
  std::optional<Duration> push_and_wait(const ObjectRef& object);
  [[nodiscard]] std::uint64_t subscription() const;

  PushSource& source_;
  const bool waits_;  // for room
  const Duration limit_;
  std::uint64_t losses_ = 0;  // not yet reported; used on the publisher's strand

  mutable Mutex mutex_;
  std::uint64_t attached_ ORCA_GUARDED_BY(mutex_) = 0;  // the number of the present subscription
  ObjectRef in_flight_ ORCA_GUARDED_BY(mutex_);         // sent, and not yet taken
  std::uint64_t ticket_ ORCA_GUARDED_BY(mutex_) = 0;
  bool taken_ ORCA_GUARDED_BY(mutex_) = false;

  const std::unique_ptr<FrameEnd> end_;  // the last member: its handlers use the others
};

}  // namespace orca::frames
