// SPDX-License-Identifier: GPL-3.0-or-later
#include "bare_dds.hpp"

#include <fastdds/rtps/transport/UDPv4TransportDescriptor.h>
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

// A participant that writes one topic and reads another.
class End {
 public:
  End(std::size_t size, std::uint32_t domain, const std::string& out, const std::string& in)
      : participant_(fd::DomainParticipantFactory::get_instance()->create_participant(domain, loopback())),
        sample_(size) {
    const fd::TypeSupport type(new BytesType(size));
    type.register_type(participant_);
    fd::DataWriterQos writer;
    writer.reliability().kind = fd::RELIABLE_RELIABILITY_QOS;
    // As Orca's link, which loses less time so than with the defaults.
    auto& times = writer.reliable_writer_qos().times;
    times.heartbeatPeriod = {0, 50'000'000};
    times.nackResponseDelay = {0, 0};
    times.nackSupressionDuration = {0, 1'000'000};
    writer_ =
        participant_->create_publisher(fd::PUBLISHER_QOS_DEFAULT)
            ->create_datawriter(participant_->create_topic(out, "Bytes", fd::TOPIC_QOS_DEFAULT), writer);
    fd::DataReaderQos reader;
    reader.reliability().kind = fd::RELIABLE_RELIABILITY_QOS;
    reader_ = participant_->create_subscriber(fd::SUBSCRIBER_QOS_DEFAULT)
                  ->create_datareader(participant_->create_topic(in, "Bytes", fd::TOPIC_QOS_DEFAULT), reader);
  }
  ~End() {
    participant_->delete_contained_entities();
    fd::DomainParticipantFactory::get_instance()->delete_participant(participant_);
  }
  End(const End&) = delete;
  End& operator=(const End&) = delete;

  void write() { writer_->write(sample_.data()); }
  // Waits for a sample and takes it; false if none comes within 100 ms.
  bool take() {
    fd::SampleInfo info;
    return reader_->wait_for_unread_message({0, 100'000'000}) &&
           reader_->take_next_sample(sample_.data(), &info) ==
               eprosima::fastrtps::types::ReturnCode_t::RETCODE_OK;
  }

 private:
  static fd::DomainParticipantQos loopback() {
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
  std::vector<std::byte> sample_;
  fd::DataWriter* writer_ = nullptr;
  fd::DataReader* reader_ = nullptr;
};

}  // namespace

class BareDdsPair::Inside {
 public:
  Inside(std::size_t size, std::uint32_t domain)
      : one_(size, domain, "there", "back"), other_(size, domain, "back", "there"), echo_([this] {
          while (!ending_)
            if (other_.take()) other_.write();
        }) {
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

}  // namespace orca::bench
