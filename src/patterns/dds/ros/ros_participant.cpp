// SPDX-License-Identifier: LGPL-3.0-or-later
#include "ros_participant.hpp"

#include <fastdds/dds/core/policy/QosPolicies.hpp>
#include <fastdds/dds/domain/DomainParticipant.hpp>
#include <fastdds/dds/domain/DomainParticipantFactory.hpp>
#include <fastdds/dds/publisher/DataWriter.hpp>
#include <fastdds/dds/publisher/DataWriterListener.hpp>
#include <fastdds/dds/publisher/Publisher.hpp>
#include <fastdds/dds/subscriber/DataReader.hpp>
#include <fastdds/dds/subscriber/DataReaderListener.hpp>
#include <fastdds/dds/subscriber/SampleInfo.hpp>
#include <fastdds/dds/subscriber/Subscriber.hpp>
#include <fastdds/dds/topic/Topic.hpp>

#include <cstring>
#include <map>
#include <set>
#include <utility>

#include "dds/backend/message.hpp"
#include "dds/backend/participant_qos.hpp"
#include "dds/backend/raw_type.hpp"
#include "orca/base/log.hpp"
#include "orca/base/mutex.hpp"
#include "orca/ros/cdr.hpp"
#include "orca/ros/message_type.hpp"

namespace orca::dds::of_ros {
namespace {

namespace fd = eprosima::fastdds::dds;
namespace rtps = eprosima::fastrtps::rtps;

using Octets = std::vector<rtps::octet>;

Octets octets_of(const std::string& text) { return {text.begin(), text.end()}; }

Gid to_gid(const rtps::GUID_t& guid) {
  Gid gid;
  std::memcpy(gid.data(), guid.guidPrefix.value, sizeof guid.guidPrefix.value);
  std::memcpy(gid.data() + sizeof guid.guidPrefix.value, guid.entityId.value, sizeof guid.entityId.value);
  return gid;
}

std::string dds_topic(const RosChannel& channel) {
  return channel.name.starts_with('/') ? "rt" + channel.name : channel.name;
}

// The user data that the middlewares of ROS 2 give an endpoint, so that their tools show the type's version.
std::string type_hash(const RosChannel& channel) {
  const auto type = ros::standard_message_type(channel.message);
  return type && !type->hash.empty() ? "typehash=RIHS01_" + type->hash + ";" : "";
}

// The policies about which a writer and a reader may disagree, in the words of ROS 2.
std::string policy_name(fd::QosPolicyId_t policy) {
  switch (policy) {
    case fd::RELIABILITY_QOS_POLICY_ID: return "reliability";
    case fd::DURABILITY_QOS_POLICY_ID: return "durability";
    case fd::DEADLINE_QOS_POLICY_ID: return "deadline";
    case fd::LIVELINESS_QOS_POLICY_ID: return "liveliness";
    case fd::OWNERSHIP_QOS_POLICY_ID: return "ownership";
    default: return "policy " + std::to_string(policy) + " of DDS";
  }
}

// The settings that a writer and a reader of a channel share.
template <class Qos>
void set(Qos& qos, const RosChannel& channel) {
  qos.durability().kind =
      channel.is_latched ? fd::TRANSIENT_LOCAL_DURABILITY_QOS : fd::VOLATILE_DURABILITY_QOS;
  qos.reliability().kind =
      channel.is_reliable ? fd::RELIABLE_RELIABILITY_QOS : fd::BEST_EFFORT_RELIABILITY_QOS;
  qos.history().kind = fd::KEEP_LAST_HISTORY_QOS;
  qos.history().depth = channel.depth;
  qos.endpoint().history_memory_policy = rtps::DYNAMIC_REUSABLE_MEMORY_MODE;
  qos.data_sharing().off();
  qos.user_data().setValue(octets_of(type_hash(channel)));
}

class Writer final : public RosWriter, private fd::DataWriterListener {
 public:
  Writer(fd::Publisher& publisher, fd::Topic& topic, RosChannel channel, std::function<void()> changed)
      : publisher_(publisher),
        channel_(std::move(channel)),
        changed_(std::move(changed)),
        writer_(publisher.create_datawriter(&topic, qos(), this,
                                            fd::StatusMask::publication_matched()
                                                << fd::StatusMask::offered_incompatible_qos())) {}
  ~Writer() override {
    if (writer_ == nullptr) return;
    writer_->set_listener(nullptr);
    std::size_t removed = 0;
    writer_->clear_history(&removed);  // for the reason, see dds::Writer
    publisher_.delete_datawriter(writer_);
  }
  [[nodiscard]] bool is_there() const { return writer_ != nullptr; }

  void write(std::span<const std::byte> payload) override {
    const std::span<const std::byte> fields = payload.subspan(ros::kEncapsulation);
    Outgoing outgoing{nullptr, fields, fields.size()};
    writer_->write(&outgoing);
  }
  [[nodiscard]] int readers() const override { return readers_; }
  [[nodiscard]] Gid gid() const override { return to_gid(writer_->guid()); }

 private:
  [[nodiscard]] fd::DataWriterQos qos() const {
    fd::DataWriterQos qos;
    set(qos, channel_);
    // Zero, the default, lets each write wake the thread of events.
    qos.reliable_writer_qos().times.nackSupressionDuration = eprosima::fastrtps::Duration_t(0.001L);
    return qos;
  }

  void on_publication_matched(fd::DataWriter* /*writer*/,
                              const fd::PublicationMatchedStatus& status) override {
    readers_ = status.current_count;
    changed_();
  }

  void on_offered_incompatible_qos(fd::DataWriter* /*writer*/,
                                   const fd::OfferedIncompatibleQosStatus& status) override {
    log::warning(channel_.user,
                 "a reader of topic " + channel_.name + " gets nothing: it asks for another " +
                     policy_name(status.last_policy_id) + " than this port offers, which is reliable and " +
                     (channel_.is_latched ? "transient local" : "volatile; choose these or less there"));
  }

  fd::Publisher& publisher_;
  const RosChannel channel_;
  const std::function<void()> changed_;
  std::atomic<int> readers_{0};
  fd::DataWriter* const writer_;
};

class Reader final : public RosReader, private fd::DataReaderListener {
 public:
  Reader(fd::Subscriber& subscriber, fd::Topic& topic, RosChannel channel, RosParticipant::Received received)
      : subscriber_(subscriber),
        channel_(std::move(channel)),
        received_(std::move(received)),
        reader_(subscriber.create_datareader(&topic, qos(), this,
                                             fd::StatusMask::data_available()
                                                 << fd::StatusMask::requested_incompatible_qos())) {}
  ~Reader() override {
    if (reader_ == nullptr) return;
    reader_->set_listener(nullptr);
    subscriber_.delete_datareader(reader_);
  }
  [[nodiscard]] bool is_there() const { return reader_ != nullptr; }
  [[nodiscard]] Gid gid() const override { return to_gid(reader_->guid()); }

 private:
  [[nodiscard]] fd::DataReaderQos qos() const {
    fd::DataReaderQos qos;
    set(qos, channel_);
    return qos;
  }

  void on_data_available(fd::DataReader* reader) override {
    using eprosima::fastrtps::types::ReturnCode_t;
    std::vector<std::byte> bytes;
    fd::SampleInfo info;
    while (reader->take_next_sample(&bytes, &info) == ReturnCode_t::RETCODE_OK) {
      if (!info.valid_data) continue;
      // The type has left out the encapsulation, after it was checked.
      std::byte* const payload = bytes.data() + kHeadroom - ros::kEncapsulation;
      std::memset(payload, 0, ros::kEncapsulation);
      std::memcpy(payload, ros::kPlainCdr.data(), ros::kPlainCdr.size());
      received_(std::span<const std::byte>(payload, bytes.data() + bytes.size()));
    }
  }

  void on_requested_incompatible_qos(fd::DataReader* /*reader*/,
                                     const fd::RequestedIncompatibleQosStatus& status) override {
    const std::string offers = std::string(channel_.is_reliable ? "reliable" : "best effort") + " and " +
                               (channel_.is_latched ? "transient local" : "volatile");
    log::warning(channel_.user, "a writer of topic " + channel_.name + " is not heard: it offers less " +
                                    policy_name(status.last_policy_id) + " than this port needs, which is " +
                                    offers);
  }

  fd::Subscriber& subscriber_;
  const RosChannel channel_;
  const RosParticipant::Received received_;
  fd::DataReader* const reader_;
};

Error refused(const std::string& what) { return fail(Code::unavailable, "Fast DDS makes no " + what); }

class FastRosParticipant final : public RosParticipant {
 public:
  explicit FastRosParticipant(fd::DomainParticipant* participant)
      : participant_(participant),
        publisher_(participant->create_publisher(fd::PUBLISHER_QOS_DEFAULT)),
        subscriber_(participant->create_subscriber(fd::SUBSCRIBER_QOS_DEFAULT)) {}
  ~FastRosParticipant() override {
    participant_->delete_contained_entities();
    fd::DomainParticipantFactory::get_instance()->delete_participant(participant_);
  }
  [[nodiscard]] bool is_complete() const { return publisher_ != nullptr && subscriber_ != nullptr; }

  Result<std::shared_ptr<RosWriter>> make_writer(const RosChannel& channel,
                                                 std::function<void()> changed) override {
    const Result<fd::Topic*> topic = this->topic(channel);
    if (!topic) return topic.error();
    auto writer = std::make_shared<Writer>(*publisher_, **topic, channel, std::move(changed));
    if (!writer->is_there()) return refused("writer for " + channel.name);
    return std::shared_ptr<RosWriter>(std::move(writer));
  }

  Result<std::unique_ptr<RosReader>> make_reader(const RosChannel& channel, Received received) override {
    const Result<fd::Topic*> topic = this->topic(channel);
    if (!topic) return topic.error();
    auto reader = std::make_unique<Reader>(*subscriber_, **topic, channel, std::move(received));
    if (!reader->is_there()) return refused("reader for " + channel.name);
    return std::unique_ptr<RosReader>(std::move(reader));
  }

  [[nodiscard]] Gid gid() const override { return to_gid(participant_->guid()); }

 private:
  // One message per topic, as in all of ROS 2.
  Result<fd::Topic*> topic(const RosChannel& channel) {
    const MutexLock lock(mutex_);
    const bool is_of_ros = channel.message.find("::") == std::string::npos;
    const std::string type = is_of_ros ? ros::dds_type_name(channel.message) : channel.message;
    if (const auto known = topics_.find(channel.name); known != topics_.end()) {
      if (known->second->get_type_name() == type) return known->second;
      return fail(Code::invalid_argument, "topic " + channel.name + " has another message at another port");
    }
    if (types_.insert(type).second) participant_->register_type(fd::TypeSupport(new RawType(type)));
    fd::Topic* const made = participant_->create_topic(dds_topic(channel), type, fd::TOPIC_QOS_DEFAULT);
    if (made == nullptr) return refused("topic " + channel.name);
    topics_.emplace(channel.name, made);
    return made;
  }

  fd::DomainParticipant* const participant_;
  fd::Publisher* const publisher_;
  fd::Subscriber* const subscriber_;
  Mutex mutex_;
  std::map<std::string, fd::Topic*> topics_ ORCA_GUARDED_BY(mutex_);  // until the participant goes
  std::set<std::string> types_ ORCA_GUARDED_BY(mutex_);
};

}  // namespace

Result<std::unique_ptr<RosParticipant>> RosParticipant::open(const ParticipantOptions& options) {
  prepare_library();
  DdsOptions network;
  network.address = options.address;
  fd::DomainParticipantQos qos = participant_qos(network);
  qos.name(options.name);
  qos.user_data().setValue(octets_of(options.user_data));
  fd::DomainParticipant* const made =
      fd::DomainParticipantFactory::get_instance()->create_participant(options.domain, qos);
  if (made == nullptr)
    return fail(Code::unavailable, "Fast DDS does not start in domain " + std::to_string(options.domain) +
                                       "; is the network interface there?");
  auto participant = std::make_unique<FastRosParticipant>(made);
  if (!participant->is_complete()) return refused("publisher or subscriber");
  return std::unique_ptr<RosParticipant>(std::move(participant));
}

}  // namespace orca::dds::of_ros
