// SPDX-License-Identifier: GPL-3.0-or-later
#include "bare_dds.hpp"

#include <fastdds/rtps/transport/UDPv4TransportDescriptor.h>
#include <fastrtps/xmlparser/XMLProfileManager.h>
#include <fastdds/dds/domain/DomainParticipant.hpp>
#include <fastdds/dds/domain/DomainParticipantFactory.hpp>
#include <fastdds/dds/publisher/DataWriter.hpp>
#include <fastdds/dds/publisher/Publisher.hpp>
#include <fastdds/dds/subscriber/DataReader.hpp>
#include <fastdds/dds/subscriber/SampleInfo.hpp>
#include <fastdds/dds/subscriber/Subscriber.hpp>
#include <fastdds/dds/topic/Topic.hpp>
#include <fastdds/dds/topic/TopicDataType.hpp>

#include <atomic>
#include <chrono>
#include <cstring>
#include <string>
#include <thread>
#include <vector>

namespace orca::bench {
namespace {

namespace fd = eprosima::fastdds::dds;
namespace fr = eprosima::fastrtps;
namespace rtps = eprosima::fastrtps::rtps;

constexpr std::size_t kEncapsulation = 4;          // [bytes]
constexpr std::uint32_t kSocketBuffer = 4U << 20;  // [bytes], as Orca's link has

// Bytes that are copied in and out.
class BytesType final : public fd::TopicDataType {
 public:
  explicit BytesType(std::size_t size) : size_(size) {
    setName("Bytes");
    m_typeSize = static_cast<std::uint32_t>(kEncapsulation + size);
    auto_fill_type_object(false);
    auto_fill_type_information(false);
  }

  bool serialize(void* data, rtps::SerializedPayload_t* payload) override {
    std::memcpy(payload->data + kEncapsulation, data, size_);
    payload->length = m_typeSize;
    return true;
  }
  bool deserialize(rtps::SerializedPayload_t* payload, void* data) override {
    std::memcpy(data, payload->data + kEncapsulation, size_);
    return true;
  }
  std::function<std::uint32_t()> getSerializedSizeProvider(void* /*data*/) override {
    return [this] { return m_typeSize; };
  }
  void* createData() override { return new std::byte[size_]; }
  void deleteData(void* data) override { delete[] static_cast<std::byte*>(data); }
  bool getKey(void* /*data*/, rtps::InstanceHandle_t* /*handle*/, bool /*force_md5*/) override {
    return false;
  }

 private:
  const std::size_t size_;
};

// A participant that writes some topics and reads others, all of one type.
class End {
 public:
  End(std::size_t size, std::uint32_t domain)
      : participant_(fd::DomainParticipantFactory::get_instance()->create_participant(domain, loopback())),
        publisher_(participant_->create_publisher(fd::PUBLISHER_QOS_DEFAULT)),
        subscriber_(participant_->create_subscriber(fd::SUBSCRIBER_QOS_DEFAULT)),
        sample_(size) {
    const fd::TypeSupport type(new BytesType(size));
    type.register_type(participant_);
  }
  ~End() {
    participant_->delete_contained_entities();
    fd::DomainParticipantFactory::get_instance()->delete_participant(participant_);
  }
  End(const End&) = delete;
  End& operator=(const End&) = delete;

  void add_writer(const std::string& name) {
    fd::DataWriterQos qos;
    qos.reliability().kind = fd::RELIABLE_RELIABILITY_QOS;
    // As Orca's link, which loses less time so than with the defaults.
    auto& times = qos.reliable_writer_qos().times;
    times.heartbeatPeriod = {0, 50'000'000};
    times.nackResponseDelay = {0, 0};
    times.nackSupressionDuration = {0, 1'000'000};
    writers_.push_back(publisher_->create_datawriter(topic(name), qos));
  }
  void add_reader(const std::string& name) {
    fd::DataReaderQos qos;
    qos.reliability().kind = fd::RELIABLE_RELIABILITY_QOS;
    readers_.push_back(subscriber_->create_datareader(topic(name), qos));
  }

  void write(std::size_t writer = 0) { writers_[writer]->write(sample_.data()); }
  // Waits for a sample and takes it; false if none comes in time.
  bool take(std::size_t reader = 0, fr::Duration_t limit = {0, 100'000'000}) {
    fd::SampleInfo info;
    return readers_[reader]->wait_for_unread_message(limit) &&
           readers_[reader]->take_next_sample(sample_.data(), &info) == fr::types::ReturnCode_t::RETCODE_OK;
  }

 private:
  fd::Topic* topic(const std::string& name) {
    return participant_->create_topic(name, "Bytes", fd::TOPIC_QOS_DEFAULT);
  }

  static fd::DomainParticipantQos loopback() {
    fr::LibrarySettingsAttributes settings;
    settings.intraprocess_delivery = fr::INTRAPROCESS_OFF;  // as between processes
    fr::xmlparser::XMLProfileManager::library_settings(settings);
    fd::DomainParticipantQos qos;
    auto udp = std::make_shared<eprosima::fastdds::rtps::UDPv4TransportDescriptor>();
    udp->interfaceWhiteList = {"127.0.0.1"};
    udp->sendBufferSize = kSocketBuffer;
    udp->receiveBufferSize = kSocketBuffer;
    qos.transport().use_builtin_transports = false;
    qos.transport().user_transports = {udp};
    return qos;
  }

  fd::DomainParticipant* const participant_;
  fd::Publisher* const publisher_;
  fd::Subscriber* const subscriber_;
  std::vector<std::byte> sample_;
  std::vector<fd::DataWriter*> writers_;
  std::vector<fd::DataReader*> readers_;
};

}  // namespace

class BareDdsPair::Inside {
 public:
  Inside(std::size_t size, std::uint32_t domain) : one_(size, domain), other_(size, domain) {
    one_.add_writer("there");
    one_.add_reader("back");
    other_.add_writer("back");
    other_.add_reader("there");
    echo_ = std::thread([this] {
      while (!ending_)
        if (other_.take()) other_.write();
    });
    do one_.write();
    while (!one_.take());
    while (one_.take()) continue;  // what else was written until both were matched
  }
  ~Inside() {
    ending_ = true;
    echo_.join();
  }

  void round_trip() {
    one_.write();
    one_.take();
  }

 private:
  End one_;
  End other_;
  std::atomic<bool> ending_{false};
  std::thread echo_;
};

BareDdsPair::BareDdsPair(std::size_t size, std::uint32_t domain)
    : inside_(std::make_unique<Inside>(size, domain)) {}

BareDdsPair::~BareDdsPair() = default;

double BareDdsPair::time(int round_trips) {
  const auto start = std::chrono::steady_clock::now();
  for (int i = 0; i < round_trips; ++i) inside_->round_trip();
  const std::chrono::duration<double, std::nano> taken = std::chrono::steady_clock::now() - start;
  return taken.count() / (2 * round_trips);
}

double start_bare_dds(int topics, std::size_t size, std::uint32_t domain) {
  const auto start = std::chrono::steady_clock::now();
  End from(size, domain);
  End to(size, domain);
  for (int i = 0; i < topics; ++i) {
    const std::string name = "many" + std::to_string(i);
    from.add_writer(name);
    to.add_reader(name);
  }
  const auto count = static_cast<std::size_t>(topics);
  for (std::size_t i = 0; i < count; ++i) from.write(i);
  for (std::size_t i = 0; i < count; ++i)
    while (!to.take(i, {0, 1'000'000})) from.write(i);  // what is written before both know each other is lost
  return std::chrono::duration<double, std::nano>(std::chrono::steady_clock::now() - start).count();
}

}  // namespace orca::bench
