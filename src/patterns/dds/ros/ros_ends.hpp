// SPDX-License-Identifier: LGPL-3.0-or-later
// The ends of ports that speak to ROS 2.
#pragma once

#include <atomic>
#include <memory>
#include <optional>
#include <string>

#include "orca/patterns/endpoints/request_link.hpp"
#include "orca/ros/range_ring.hpp"
#include "orca/ros/twin.hpp"
#include "topic_ends.hpp"

namespace orca::dds::of_ros {

/// A topic of ROS 2 on which a port publishes.
///
/// Thread contract: as TopicWriter.
class RosPublication final : public TopicPublication {
 public:
  /// @param twin  of the port's type: what is written.
  RosPublication(std::shared_ptr<RosWriter> writer, const ros::Twin& twin, RosFrames& frames)
      : TopicPublication(std::move(writer)), twin_(twin), frames_(frames) {}

  using TopicPublication::write;
  bool write(const ObjectRef& object, std::size_t size, const Label& label) override;
  [[nodiscard]] bool are_frames_heard() const override { return frames_.are_heard(); }
  [[nodiscard]] bool is_latched() const override { return twin_.is_latched; }

 private:
  const ros::Twin& twin_;
  RosFrames& frames_;
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

/// A topic of ROS 2 that a port hears.
///
/// Thread contract: as TopicIntake.
class RosIntake : public TopicIntake {
 public:
  /// @param user  the port, for people.
  RosIntake(Strand& strand, std::string user, std::string topic, const ros::Twin& twin, RosFrames& frames)
      : TopicIntake(strand, std::move(user), std::move(topic)), twin_(twin), frames_(frames) {}

 private:
  ObjectRef read(std::span<const std::byte> payload, TimePoint now) override;
  [[nodiscard]] std::optional<idl::Frame3D> find_mount(const std::string& frame);

  const ros::Twin& twin_;
  RosFrames& frames_;
  ros::RangeRing ring_;            // used by the reader's callback, as the rest
  bool is_mount_missing_ = false;  // of the message that is read now
  bool warned_of_mount_ = false;
  bool complained_ = false;
};

/// The server of a PushProxy that hears a topic.
///
/// Thread contract: as PushSource and Intake.
class RosToPush final : public RosIntake, public LinkEnd {
 public:
  RosToPush(Strand& strand, std::string user, const std::string& topic, const ros::Twin& twin,
            RosFrames& frames)
      : RosIntake(strand, std::move(user), topic, twin, frames), source_(strand, topic) {}
  ~RosToPush() override { close(); }
  [[nodiscard]] PushSource& source() { return source_; }

 private:
  void pass_on(ObjectRef object) override { source_.pass_on(std::move(object)); }
  void pass_on_losses(std::uint64_t objects) override { source_.pass_on_losses(objects); }

  TopicSource source_;
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
