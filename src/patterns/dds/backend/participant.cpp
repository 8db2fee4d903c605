// SPDX-License-Identifier: LGPL-3.0-or-later
#include "participant.hpp"

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
#include <mutex>
#include <optional>
#include <set>
#include <utility>

#include "orca/base/mutex.hpp"
#include "orca/dds/gate.hpp"
#include "participant_qos.hpp"
#include "raw_type.hpp"

namespace orca::dds {
namespace {

namespace fd = eprosima::fastdds::dds;
namespace rtps = eprosima::fastrtps::rtps;

// Marks a sample as one with a label.
constexpr std::array<std::uint8_t, 4> kMark{'o', 'r', 'c', 'a'};
constexpr int kLowBits = 32;

rtps::SampleIdentity to_identity(const Label& label) {
  rtps::SampleIdentity identity;
  rtps::GUID_t guid;
  std::memcpy(guid.guidPrefix.value, &label.layout_hash, sizeof label.layout_hash);
  std::memcpy(guid.guidPrefix.value + sizeof label.layout_hash, &label.epoch, sizeof label.epoch);
  std::memcpy(guid.entityId.value, kMark.data(), kMark.size());
  identity.writer_guid(guid);
  identity.sequence_number(
      {static_cast<std::int32_t>(label.edges >> kLowBits), static_cast<std::uint32_t>(label.edges)});
  return identity;
}

// Returns the label; one without edges if the sample has none.
Label to_label(const rtps::SampleIdentity& identity) {
  Label label{};
  const rtps::GUID_t& guid = identity.writer_guid();
  if (std::memcmp(guid.entityId.value, kMark.data(), kMark.size()) != 0) return label;
  std::memcpy(&label.layout_hash, guid.guidPrefix.value, sizeof label.layout_hash);
  std::memcpy(&label.epoch, guid.guidPrefix.value + sizeof label.layout_hash, sizeof label.epoch);
  const rtps::SequenceNumber_t& bits = identity.sequence_number();
  label.edges = (std::uint64_t{static_cast<std::uint32_t>(bits.high)} << kLowBits) | bits.low;
  return label;
}

// A topic that writers and readers share. The last of them takes it away.
class SharedTopic {
 public:
  SharedTopic(fd::DomainParticipant& participant, fd::Topic* topic)
      : participant_(participant), topic_(topic) {}
  ~SharedTopic() { participant_.delete_topic(topic_); }
  SharedTopic(const SharedTopic&) = delete;
  SharedTopic& operator=(const SharedTopic&) = delete;
  [[nodiscard]] fd::Topic* get() const { return topic_; }

 private:
  fd::DomainParticipant& participant_;
  fd::Topic* topic_;
};
using TopicPtr = std::shared_ptr<SharedTopic>;

class Writer final : public TopicWriter, private fd::DataWriterListener {
 public:
  Writer(fd::Publisher& publisher, TopicPtr topic, const TopicOptions& options)
      : publisher_(publisher),
        topic_(std::move(topic)),
        found_(options.found),
        writer_(publisher.create_datawriter(topic_->get(), writer_qos(options), this,
                                            fd::StatusMask::publication_matched())) {}
  ~Writer() override {
    if (writer_ == nullptr) return;
    writer_->set_listener(nullptr);
    // While Fast DDS 2.9 deletes a writer, its own thread may walk along the samples that go, and then for ever: its pull request 4076
    // mends that. Where there are none, it does not.
    std::size_t removed = 0;
    writer_->clear_history(&removed);
    publisher_.delete_datawriter(writer_);
  }
  [[nodiscard]] bool is_there() const { return writer_ != nullptr; }

  bool write(const ObjectRef& object, std::size_t size, const Label& label) override {
    Outgoing outgoing{&object, {}, size};
    rtps::WriteParams with;
    with.related_sample_identity(to_identity(label));
    return writer_->write(&outgoing, with);
  }
  bool write(std::vector<std::byte> message) override {
    Outgoing outgoing{nullptr, message, sizeof(std::uint32_t) + message.size()};
    return writer_->write(&outgoing);
  }

 private:
  void on_publication_matched(fd::DataWriter* /*writer*/,
                              const fd::PublicationMatchedStatus& status) override {
    if (found_ && status.current_count_change > 0) found_();
  }

  fd::Publisher& publisher_;
  const TopicPtr topic_;
  const std::function<void()> found_;
  fd::DataWriter* const writer_;
};

class Reader final : public TopicReader, private fd::DataReaderListener {
 public:
  Reader(fd::Subscriber& subscriber, TopicPtr topic, const TopicOptions& options,
         Participant::Received received)
      : subscriber_(subscriber),
        topic_(std::move(topic)),
        found_(options.found),
        received_(std::move(received)),
        reader_(subscriber.create_datareader(topic_->get(), reader_qos(options.depth), this,
                                             fd::StatusMask::data_available()
                                                 << fd::StatusMask::subscription_matched())) {}
  ~Reader() override {
    if (reader_ == nullptr) return;
    reader_->set_listener(nullptr);
    subscriber_.delete_datareader(reader_);
  }
  [[nodiscard]] bool is_there() const { return reader_ != nullptr; }

 private:
  void on_data_available(fd::DataReader* reader) override {
    std::vector<std::byte> bytes;
    fd::SampleInfo info;
    while (reader->take_next_sample(&bytes, &info) == eprosima::fastrtps::types::ReturnCode_t::RETCODE_OK)
      if (info.valid_data) pass_on(std::move(bytes), info);
  }

  void on_subscription_matched(fd::DataReader* /*reader*/,
                               const fd::SubscriptionMatchedStatus& status) override {
    if (found_ && status.current_count_change > 0) found_();
  }

  void pass_on(std::vector<std::byte> bytes, const fd::SampleInfo& info) {
    Sample sample{std::move(bytes), to_label(info.related_sample_identity), {}, 0};
    const rtps::GUID_t& writer = info.sample_identity.writer_guid();
    std::memcpy(sample.origin.data(), writer.guidPrefix.value, sample.origin.size());
    sample.sequence = info.sample_identity.sequence_number().to64long();
    received_(std::move(sample));
  }

  fd::Subscriber& subscriber_;
  const TopicPtr topic_;
  const std::function<void()> found_;
  const Participant::Received received_;
  fd::DataReader* const reader_;
};

Error refused(const std::string& what) { return fail(Code::unavailable, "Fast DDS makes no " + what); }

class FastParticipant final : public Participant {
 public:
  /// @param gate  null: it is not secured.
  FastParticipant(fd::DomainParticipant* participant, std::shared_ptr<Gate> gate)
      : gate_(std::move(gate)),
        participant_(participant),
        publisher_(participant->create_publisher(fd::PUBLISHER_QOS_DEFAULT)),
        subscriber_(participant->create_subscriber(fd::SUBSCRIBER_QOS_DEFAULT)) {}
  ~FastParticipant() override {
    participant_->delete_contained_entities();
    fd::DomainParticipantFactory::get_instance()->delete_participant(participant_);
  }

  [[nodiscard]] bool is_complete() const { return publisher_ != nullptr && subscriber_ != nullptr; }

  void look_after_keys(std::chrono::system_clock::time_point now) override {
    if (gate_ != nullptr) gate_->look(now);
  }
  [[nodiscard]] bool may_speak_for(const Origin& speaker, const std::string& process) const override {
    if (gate_ == nullptr) return true;
    const std::optional<keys::Certificate> certificate = gate_->certificate_of(speaker);
    return certificate && certificate->process == process;
  }

  Result<std::shared_ptr<TopicWriter>> make_writer(const TopicOptions& options) override {
    const TopicPtr topic = this->topic(options);
    if (topic == nullptr) return refused("topic " + options.name);
    auto writer = std::make_shared<Writer>(*publisher_, topic, options);
    if (!writer->is_there()) return refused_endpoint("writer", options);
    return std::shared_ptr<TopicWriter>(std::move(writer));
  }

  Result<std::unique_ptr<TopicReader>> make_reader(const TopicOptions& options, Received received) override {
    const TopicPtr topic = this->topic(options);
    if (topic == nullptr) return refused("topic " + options.name);
    auto reader = std::make_unique<Reader>(*subscriber_, topic, options, std::move(received));
    if (!reader->is_there()) return refused_endpoint("reader", options);
    return std::unique_ptr<TopicReader>(std::move(reader));
  }

 private:
  [[nodiscard]] Error refused_endpoint(const std::string& what, const TopicOptions& options) const {
    Error error = refused(what + " for " + options.name);
    if (gate_ != nullptr)
      error.message +=
          "; the permissions of this process may be those of another graph: orcactl keys GRAPH --renew makes "
          "them anew";
    return error;
  }

  TopicPtr topic(const TopicOptions& options) {
    const MutexLock lock(mutex_);
    std::weak_ptr<SharedTopic>& known = topics_[options.name];
    if (TopicPtr topic = known.lock()) return topic;
    if (!types_.contains(options.type)) {
      participant_->register_type(fd::TypeSupport(new RawType(options.type)));
      types_.insert(options.type);
    }
    fd::Topic* const made = participant_->create_topic(options.name, options.type, fd::TOPIC_QOS_DEFAULT);
    if (made == nullptr) return nullptr;
    TopicPtr topic = std::make_shared<SharedTopic>(*participant_, made);
    known = topic;
    return topic;
  }

  const std::shared_ptr<Gate> gate_;
  fd::DomainParticipant* const participant_;
  fd::Publisher* const publisher_;
  fd::Subscriber* const subscriber_;
  Mutex mutex_;
  std::map<std::string, std::weak_ptr<SharedTopic>> topics_ ORCA_GUARDED_BY(mutex_);
  std::set<std::string> types_ ORCA_GUARDED_BY(mutex_);
};

}  // namespace

Result<std::unique_ptr<Participant>> Participant::open(const DdsOptions& options) {
  prepare_library();
  fd::DomainParticipantQos qos = participant_qos(options);
  std::shared_ptr<Gate> gate;
  if (!options.keys.empty()) {
    Result<std::shared_ptr<Gate>> opened = Gate::open(options.keys, options.process);
    if (!opened) return opened.error();
    gate = std::move(opened).value();
    secure(qos, gate);
  }
  fd::DomainParticipant* const made = fd::DomainParticipantFactory::get_instance()->create_participant(
      options.domain, qos, gate.get(), fd::StatusMask::none());
  if (made == nullptr)
    return fail(Code::unavailable,
                "Fast DDS does not start; is " + options.address + " an address of this machine" +
                    (gate == nullptr ? "?" : ", and do its keys fit? The log has its reason"));
  auto participant = std::make_unique<FastParticipant>(made, std::move(gate));
  if (!participant->is_complete()) return refused("publisher or subscriber");
  return std::unique_ptr<Participant>(std::move(participant));
}

}  // namespace orca::dds
