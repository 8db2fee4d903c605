// SPDX-License-Identifier: LGPL-3.0-or-later
// The ends of ports that speak to ROS 2.
#pragma once

#include <atomic>
#include <deque>
#include <memory>
#include <optional>
#include <string>

#include "dds/backend/outbox.hpp"
#include "orca/base/mutex.hpp"
#include "orca/base/strand.hpp"
#include "orca/patterns/endpoints/endpoint.hpp"
#include "orca/patterns/endpoints/push_link.hpp"
#include "orca/patterns/endpoints/request_link.hpp"
#include "orca/ros/range_ring.hpp"
#include "orca/ros/twin.hpp"
#include "ros_frames.hpp"
#include "ros_participant.hpp"

namespace orca::dds::of_ros {

/// A topic on which a port publishes. Objects become messages on the outbox's thread.
///
/// Thread contract: as TopicWriter.
class RosPublication final : public TopicWriter {
 public:
  /// @param twin  of the port's type: what is written.
  RosPublication(std::shared_ptr<RosWriter> writer, const ros::Twin& twin, RosFrames& frames)
      : writer_(std::move(writer)), twin_(twin), frames_(frames) {}

  bool write(const ObjectRef& object, std::size_t size, const Label& label) override;
  bool write(std::vector<std::byte> messages) override;
  [[nodiscard]] bool has_readers() const { return writer_->readers() > 0; }
  [[nodiscard]] bool are_frames_heard() const { return frames_.are_heard(); }

  [[nodiscard]] bool is_latched() const { return twin_.is_latched; }

  /// Lets the outbox write an object. If too much waits there it is dropped, unless readers that come later want it.
  /// @return whether it will be written.
  static bool post(const std::shared_ptr<RosPublication>& to, const ObjectRef& object, Outbox& outbox);

 private:
  const std::shared_ptr<RosWriter> writer_;
  const ros::Twin& twin_;
  RosFrames& frames_;
};

/// The objects for which a port is subscribed to without readers of its topic.
enum class Unread {
  nothing,
  first,  ///< The first object, which says where a sensor is mounted.
  moves,  ///< All of them while others hear on /tf how robots move.
  all     ///< The latest object, for readers that come later.
};

/// The client of a PushServer that publishes its objects. It is subscribed while somebody reads the topic.
///
/// Thread contract: as PushSink and Intake.
class PushToRos final : public PushSink, public Intake, public LinkEnd {
 public:
  PushToRos(Strand& strand, PushSource& source, std::shared_ptr<RosPublication> publication, Outbox& outbox,
            std::shared_ptr<Bell> bell, Unread unread);
  ~PushToRos() override;

  std::optional<Duration> deliver(ObjectRef&& object) override;
  void give_up(const ObjectRef& /*object*/) override {}
  void granted(const UpdateGrant& /*grant*/) override {}
  void lost(std::uint64_t /*objects*/) override {}
  bool take_in() override;

 private:
  Strand& strand_;
  PushSource& source_;
  const std::shared_ptr<RosPublication> publication_;
  Outbox& outbox_;
  const std::shared_ptr<Bell> bell_;
  std::atomic<Unread> unread_;
  Mutex mutex_;  // held by whoever subscribes or ends that
  bool attached_ ORCA_GUARDED_BY(mutex_) = false;
};

/// The server of a SendProxy that publishes what is sent.
///
/// Thread contract: as RequestTarget.
class SendToRos final : public SendTarget, public LinkEnd {
 public:
  SendToRos(std::string topic, std::shared_ptr<RosPublication> publication, Outbox& outbox)
      : topic_(std::move(topic)), publication_(std::move(publication)), outbox_(outbox) {}

  /// @errors  unavailable if nobody reads the topic.
  std::optional<Status> offer(const ObjectRef& object, SendReplySink& reply_to, RequestId id,
                              bool may_wait) override;
  void withdraw(RequestId /*id*/) override {}
  [[nodiscard]] Duration patience() const override { return Duration{0}; }
  [[nodiscard]] std::string path() const override { return topic_; }

 private:
  const std::string topic_;
  const std::shared_ptr<RosPublication> publication_;
  Outbox& outbox_;
};

/// A topic that a port hears. Messages become objects on a thread of DDS, and wait for the port's strand.
///
/// Thread contract: as Intake.
class RosIntake : public Intake {
 public:
  /// @param user  the port, for people.
  RosIntake(Strand& strand, std::string user, std::string topic, const ros::Twin& twin, RosFrames& frames);
  ~RosIntake() override = default;

  /// Begins to hear.
  /// @errors  those of make_reader().
  Status open(RosParticipant& participant, const RosChannel& channel);
  [[nodiscard]] Gid gid() const { return reader_->gid(); }
  [[nodiscard]] const std::string& topic() const { return topic_; }
  bool take_in() override;

 protected:
  /// Ends to hear. Each final class calls it in its destructor.
  void close();
  [[nodiscard]] Strand& strand() const { return strand_; }
  [[nodiscard]] const std::string& user() const { return user_; }

 private:
  struct Waiting {
    ObjectRef object;
    std::size_t size;  // as it came [bytes]
  };

  virtual void pass_on(ObjectRef object) = 0;
  virtual void pass_on_losses(std::uint64_t objects) = 0;
  void hear(std::span<const std::byte> payload);
  [[nodiscard]] std::optional<idl::Frame3D> find_mount(const std::string& frame);
  void keep(ObjectRef object, std::size_t size);

  Strand& strand_;
  const std::string user_;
  const std::string topic_;
  const ros::Twin& twin_;
  RosFrames& frames_;
  ros::RangeRing ring_;  // used by the reader's callback, as the next three
  TimePoint opened_{};
  bool is_mount_missing_ = false;  // of the message that is read now
  bool warned_of_mount_ = false;
  std::atomic<bool> complained_{false};
  Mutex reading_;  // held by whoever takes in; before mutex_
  Mutex mutex_;
  std::deque<Waiting> waiting_ ORCA_GUARDED_BY(mutex_);
  std::size_t waiting_bytes_ ORCA_GUARDED_BY(mutex_) = 0;  // as they came
  std::uint64_t lost_ ORCA_GUARDED_BY(mutex_) = 0;
  std::unique_ptr<RosReader> reader_;  // the last member: its callback uses the others
};

/// The server of a PushProxy that hears a topic.
///
/// Thread contract: as PushSource and Intake.
class RosToPush final : public RosIntake, public PushSource, public LinkEnd {
 public:
  using RosIntake::RosIntake;
  ~RosToPush() override { close(); }

  void attach(PushSink& sink, const UpdateRate& rate) override;
  void detach() override;
  void change(const UpdateRate& rate) override;
  void room() override {}
  [[nodiscard]] Duration base_period() const override { return Duration{0}; }
  [[nodiscard]] std::string path() const override { return topic(); }

 private:
  void pass_on(ObjectRef object) override;
  void pass_on_losses(std::uint64_t objects) override;

  Mutex mutex_;
  PushSink* sink_ ORCA_GUARDED_BY(mutex_) = nullptr;  // null: not subscribed
  UpdateRate rate_ ORCA_GUARDED_BY(mutex_);
  TimePoint next_ ORCA_GUARDED_BY(mutex_){};  // with an interval: not before then
  std::uint64_t count_ ORCA_GUARDED_BY(mutex_) = 0;
};

/// The client of a SendServer that sends it what comes on a topic.
///
/// Thread contract: as ReplySink and Intake.
class RosToSend final : public RosIntake, public SendReplySink, public LinkEnd {
 public:
  RosToSend(Strand& strand, std::string user, std::string topic, const ros::Twin& twin, RosFrames& frames)
      : RosIntake(strand, std::move(user), std::move(topic), twin, frames) {}
  ~RosToSend() override { close(); }

  void use(SendTarget& target) { target_ = &target; }
  void reply(RequestId id, Status answer) override;

 private:
  void pass_on(ObjectRef object) override;
  void pass_on_losses(std::uint64_t objects) override;

  SendTarget* target_ = nullptr;
  RequestId next_ = 1;
  std::atomic<bool> refused_{false};  // the last one was, and it is reported
};

}  // namespace orca::dds::of_ros
