// SPDX-License-Identifier: LGPL-3.0-or-later
#include "orca/supervisor/bulletin.hpp"

#include <chrono>
#include <memory>
#include <span>
#include <utility>

#include <fastdds/rtps/transport/UDPv4TransportDescriptor.h>
#include <fastrtps/utils/IPLocator.h>
#include <fastdds/dds/domain/DomainParticipant.hpp>
#include <fastdds/dds/domain/DomainParticipantFactory.hpp>
#include <fastdds/dds/log/Log.hpp>
#include <fastdds/dds/publisher/DataWriter.hpp>
#include <fastdds/dds/publisher/Publisher.hpp>
#include <fastdds/dds/subscriber/DataReader.hpp>
#include <fastdds/dds/subscriber/DataReaderListener.hpp>
#include <fastdds/dds/subscriber/SampleInfo.hpp>
#include <fastdds/dds/subscriber/Subscriber.hpp>
#include <fastdds/dds/topic/Topic.hpp>
#include <fastdds/dds/topic/TypeSupport.hpp>

#include "orca/base/files/key_folder.hpp"
#include "orca/base/network_address.hpp"
#include "orca/dds/gate.hpp"
#include "orca/idl/machines.hpp"
#include "orca/idl/object_type.hpp"
#include "state_type.hpp"

namespace orca::supervisor {
namespace {

namespace dds = eprosima::fastdds::dds;
namespace rtps = eprosima::fastdds::rtps;
using eprosima::fastrtps::rtps::IPLocator;
using eprosima::fastrtps::rtps::Locator_t;

constexpr int kDepth = 64;             // states that wait to be taken
constexpr int kOthersOnAMachine = 20;  // participants that a known address is asked for
const eprosima::fastrtps::Duration_t kLease{10, 0};
// A process that is started again has to be known again well within a second, the usual loss_limit, although some
// announcements are lost: Fast DDS's own settings (five of them, then one every second) took up to 1.4 s.
const eprosima::fastrtps::Duration_t kAnnouncement{0, 200'000'000};
const eprosima::fastrtps::rtps::InitialAnnouncementConfig kFirstAnnouncements{20, {0, 50'000'000}};

// Writes what Fast DDS complains about to the log: what matters of it is noticed by the silence of a machine.
class LogConsumer final : public dds::LogConsumer {
 public:
  void Consume(const dds::Log::Entry& entry) override {
    orca::dds::log_complaint(entry.context.category, entry.message);
  }
};

Result<dds::DomainParticipantQos> participant_qos(const MeetingPlace& place) {
  const Result<std::string> own = own_address(place.interface, place.address);
  if (!own) return own.error();
  auto udp = std::make_shared<rtps::UDPv4TransportDescriptor>();
  if (!own->empty()) udp->interfaceWhiteList = {*own};
  udp->maxInitialPeersRange = kOthersOnAMachine;
  dds::DomainParticipantQos qos;
  qos.name("orca peers");
  qos.transport().use_builtin_transports = false;
  qos.transport().user_transports.push_back(udp);
  auto& discovery = qos.wire_protocol().builtin.discovery_config;
  discovery.leaseDuration = kLease;
  discovery.leaseDuration_announcementperiod = kAnnouncement;
  discovery.initial_announcements = kFirstAnnouncements;
  for (const std::string& other : place.others) {
    const Result<std::string> address = address_of_host(other);
    if (!address) return address.error();
    Locator_t locator;
    IPLocator::setIPv4(locator, *address);
    qos.wire_protocol().builtin.initialPeersList.push_back(locator);
  }
  return qos;
}

class DdsBulletin final : public Bulletin, private dds::DataReaderListener {
 public:
  explicit DdsBulletin(HearState hear) : hear_(std::move(hear)) {}
  ~DdsBulletin() override {
    if (participant_ == nullptr) return;
    if (reader_ != nullptr) reader_->set_listener(nullptr);
    participant_->delete_contained_entities();
    dds::DomainParticipantFactory::get_instance()->delete_participant(participant_);
  }

  Status open(const MeetingPlace& place) {
    Result<dds::DomainParticipantQos> qos = participant_qos(place);
    if (!qos) return qos.error();
    if (!place.keys.empty()) {
      Result<std::shared_ptr<orca::dds::Gate>> gate = orca::dds::Gate::open(place.keys, kPeersKeys);
      if (!gate) return gate.error();
      gate_ = std::move(gate).value();
      orca::dds::secure(*qos, gate_);
    }
    participant_ = dds::DomainParticipantFactory::get_instance()->create_participant(
        place.domain, *qos, gate_.get(), dds::StatusMask::none());
    if (participant_ == nullptr || !open_topic(place))
      return fail(Code::unavailable, "the network code cannot be started");
    return ok();
  }

  void say(std::span<const std::byte> state) override {
    if (gate_ != nullptr) gate_->look(std::chrono::system_clock::now());
    StateType::Sample sample(state.begin(), state.end());
    writer_->write(&sample);
  }

 private:
  bool open_topic(const MeetingPlace& place) {
    const dds::TypeSupport type(new StateType(place.type));
    if (type.register_type(participant_) != ReturnCode_t::RETCODE_OK) return false;
    dds::Topic* const topic =
        participant_->create_topic(place.topic, type.get_type_name(), dds::TOPIC_QOS_DEFAULT);
    auto* const publisher = participant_->create_publisher(dds::PUBLISHER_QOS_DEFAULT);
    auto* const subscriber = participant_->create_subscriber(dds::SUBSCRIBER_QOS_DEFAULT);
    if (topic == nullptr || publisher == nullptr || subscriber == nullptr) return false;
    writer_ = publisher->create_datawriter(topic, writer_qos());
    reader_ = subscriber->create_datareader(topic, reader_qos(), this);
    return writer_ != nullptr && reader_ != nullptr;
  }

  static dds::DataWriterQos writer_qos() {
    dds::DataWriterQos qos;
    qos.reliability().kind = dds::BEST_EFFORT_RELIABILITY_QOS;
    qos.durability().kind = dds::VOLATILE_DURABILITY_QOS;
    qos.data_sharing().off();
    qos.endpoint().history_memory_policy = eprosima::fastrtps::rtps::PREALLOCATED_WITH_REALLOC_MEMORY_MODE;
    return qos;
  }

  static dds::DataReaderQos reader_qos() {
    dds::DataReaderQos qos;
    qos.reliability().kind = dds::BEST_EFFORT_RELIABILITY_QOS;
    qos.history().depth = kDepth;
    qos.data_sharing().off();
    qos.endpoint().history_memory_policy = eprosima::fastrtps::rtps::PREALLOCATED_WITH_REALLOC_MEMORY_MODE;
    return qos;
  }

  void on_data_available(dds::DataReader* reader) override {
    StateType::Sample sample;
    dds::SampleInfo info;
    while (reader->take_next_sample(&sample, &info) == ReturnCode_t::RETCODE_OK)
      if (info.valid_data && may_say(info, sample)) hear_(sample);
  }

  // In a secured system a machine speaks for itself only.
  [[nodiscard]] bool may_say(const dds::SampleInfo& info, const StateType::Sample& sample) const {
    if (gate_ == nullptr) return true;
    const auto& writer = info.sample_identity.writer_guid().guidPrefix.value;
    const auto certificate = gate_->certificate_of(std::as_bytes(std::span(writer)));
    idl::MachineState state;
    return certificate && certificate->process == kPeersKeys &&
           object_type<idl::MachineState>().deserialize(sample, &state).ok() &&
           state.origin() == certificate->machine;
  }

  const HearState hear_;
  std::shared_ptr<orca::dds::Gate> gate_;  // null: not secured
  dds::DomainParticipant* participant_ = nullptr;
  dds::DataWriter* writer_ = nullptr;
  dds::DataReader* reader_ = nullptr;
};

}  // namespace

extern "C" Bulletin* orca_open_bulletin(const MeetingPlace& place, HearState hear, Error& error) {
  dds::Log::ClearConsumers();
  dds::Log::RegisterConsumer(std::make_unique<LogConsumer>());
  auto bulletin = std::make_unique<DdsBulletin>(std::move(hear));
  const Status opened = bulletin->open(place);
  if (opened.ok()) return bulletin.release();
  error = opened.error();
  return nullptr;
}

}  // namespace orca::supervisor
