// SPDX-License-Identifier: LGPL-3.0-or-later
// The ends of ports that speak on topics of others: of ROS 2, or of a team.
#pragma once

#include <atomic>
#include <deque>
#include <memory>
#include <optional>
#include <string>
#include <utility>

#include "dds/backend/outbox.hpp"
#include "orca/base/mutex.hpp"
#include "orca/base/strand.hpp"
#include "orca/patterns/endpoints/endpoint.hpp"
#include "orca/patterns/endpoints/push_link.hpp"
#include "ros_frames.hpp"
#include "ros_participant.hpp"

namespace orca::dds::of_ros {

/// A topic on which a port publishes. Objects become messages on the outbox's thread.
///
/// Thread contract: as TopicWriter.
class TopicPublication : public TopicWriter {
 public:
  explicit TopicPublication(std::shared_ptr<RosWriter> writer) : writer_(std::move(writer)) {}

  bool write(std::vector<std::byte> /*messages*/) final { return false; }
  using TopicWriter::write;
  [[nodiscard]] bool has_readers() const { return writer_->readers() > 0; }
  /// Returns whether others hear how robots move, and objects are wanted for that.
  [[nodiscard]] virtual bool are_frames_heard() const { return false; }
  [[nodiscard]] virtual bool is_latched() const { return false; }

  /// Lets the outbox write an object. If too much waits there it is dropped, unless readers that come later want it.
  /// @return whether it will be written.
  static bool post(const std::shared_ptr<TopicPublication>& to, const ObjectRef& object, Outbox& outbox);

 protected:
  [[nodiscard]] RosWriter& writer() { return *writer_; }

 private:
  const std::shared_ptr<RosWriter> writer_;
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
class PushToTopic final : public PushSink, public Intake, public LinkEnd {
 public:
  PushToTopic(Strand& strand, PushSource& source, std::shared_ptr<TopicPublication> publication,
              Outbox& outbox, std::shared_ptr<Bell> bell, Unread unread);
  ~PushToTopic() override;

  std::optional<Duration> deliver(ObjectRef&& object) override;
  void give_up(const ObjectRef& /*object*/) override {}
  void granted(const UpdateGrant& /*grant*/) override {}
  void lost(std::uint64_t /*objects*/) override {}
  bool take_in() override;

 private:
  Strand& strand_;
  PushSource& source_;
  const std::shared_ptr<TopicPublication> publication_;
  Outbox& outbox_;
  const std::shared_ptr<Bell> bell_;
  std::atomic<Unread> unread_;
  Mutex mutex_;  // held by whoever subscribes or ends that
  bool attached_ ORCA_GUARDED_BY(mutex_) = false;
};

/// A topic that a port hears. Messages become objects on a thread of DDS, and wait for the port's strand.
///
/// Thread contract: as Intake.
class TopicIntake : public Intake {
 public:
  /// @param user  the port, for people.
  TopicIntake(Strand& strand, std::string user, std::string topic)
      : strand_(strand), user_(std::move(user)), topic_(std::move(topic)) {}
  ~TopicIntake() override = default;

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
  /// Returns when it began to hear.
  [[nodiscard]] TimePoint opened() const { return opened_; }

 private:
  struct Waiting {
    ObjectRef object;
    std::size_t size;  // as it came [bytes]
  };

  // Returns the object that a message says; none if it is not to be passed on. Called by the reader.
  virtual ObjectRef read(std::span<const std::byte> payload, TimePoint now) = 0;
  virtual void pass_on(ObjectRef object) = 0;
  virtual void pass_on_losses(std::uint64_t objects) = 0;
  void keep(ObjectRef object, std::size_t size);

  Strand& strand_;
  const std::string user_;
  const std::string topic_;
  TimePoint opened_{};
  Mutex reading_;  // held by whoever takes in; before mutex_
  Mutex mutex_;
  std::deque<Waiting> waiting_ ORCA_GUARDED_BY(mutex_);
  std::size_t waiting_bytes_ ORCA_GUARDED_BY(mutex_) = 0;  // as they came
  std::uint64_t lost_ ORCA_GUARDED_BY(mutex_) = 0;
  std::unique_ptr<RosReader> reader_;  // the last member: its callback uses the others
};

/// The server of a PushProxy that passes on what comes on a topic.
///
/// Thread contract: as PushSource and Intake.
class TopicSource final : public PushSource {
 public:
  TopicSource(Strand& strand, std::string topic) : strand_(strand), topic_(std::move(topic)) {}

  void attach(PushSink& sink, const UpdateRate& rate) override;
  void detach() override;
  void change(const UpdateRate& rate) override;
  void room() override {}
  [[nodiscard]] Duration base_period() const override { return Duration{0}; }
  [[nodiscard]] std::string path() const override { return topic_; }

  void pass_on(ObjectRef object);
  void pass_on_losses(std::uint64_t objects);

 private:
  Strand& strand_;
  const std::string topic_;
  Mutex mutex_;
  PushSink* sink_ ORCA_GUARDED_BY(mutex_) = nullptr;  // null: not subscribed
  UpdateRate rate_ ORCA_GUARDED_BY(mutex_);
  TimePoint next_ ORCA_GUARDED_BY(mutex_){};  // with an interval: not before then
  std::uint64_t count_ ORCA_GUARDED_BY(mutex_) = 0;
};

}  // namespace orca::dds::of_ros
