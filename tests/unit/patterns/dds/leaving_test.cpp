// SPDX-License-Identifier: GPL-3.0-or-later
// A process that ends its part in DDS while another writes to it as fast as it can.
#include <catch2/catch.hpp>

#include <fastdds/dds/domain/DomainParticipant.hpp>
#include <fastdds/dds/domain/DomainParticipantFactory.hpp>
#include <fastdds/dds/publisher/DataWriter.hpp>
#include <fastdds/dds/publisher/Publisher.hpp>
#include <fastdds/dds/topic/Topic.hpp>
#include <fastdds/dds/topic/TopicDataType.hpp>

#include <array>
#include <atomic>
#include <cstring>
#include <memory>
#include <string>
#include <thread>
#include <vector>

#include "dds/backend/message.hpp"
#include "dds_links.hpp"
#include "executives.hpp"
#include "on_loopback.hpp"
#include "orca/base/hash.hpp"
#include "orca/idl/motion.hpp"
#include "peer.hpp"
#include "slow_run.hpp"

using namespace orca;
using namespace orca::test;
namespace fd = eprosima::fastdds::dds;
using Payload = eprosima::fastrtps::rtps::SerializedPayload_t;

namespace {

constexpr std::uint32_t kMost = 60'000;  // [bytes] of a sample
constexpr int kGreetings = 1000;         // in a sample, so that a line is nearly always in use

// What the inboxes of lines carry: a sequence<octet>.
class Octets final : public fd::TopicDataType {
 public:
  Octets() {
    setName("orca::dds::Message");
    m_typeSize = kMost;
    auto_fill_type_object(false);
    auto_fill_type_information(false);
  }
  bool serialize(void* data, Payload* payload) override {
    const auto& bytes = *static_cast<const std::vector<std::byte>*>(data);
    const auto length = static_cast<std::uint32_t>(bytes.size());
    constexpr std::array<unsigned char, 4> kPlain{0x00, 0x01, 0x00, 0x00};
    std::memcpy(payload->data, kPlain.data(), kPlain.size());
    std::memcpy(payload->data + kPlain.size(), &length, sizeof length);
    std::memcpy(payload->data + kPlain.size() + sizeof length, bytes.data(), bytes.size());
    payload->length = static_cast<std::uint32_t>(kPlain.size() + sizeof length + bytes.size());
    return true;
  }
  bool deserialize(Payload*, void*) override { return false; }
  std::function<std::uint32_t()> getSerializedSizeProvider(void*) override {
    return [] { return kMost; };
  }
  void* createData() override { return new std::vector<std::byte>; }
  void deleteData(void* data) override { delete static_cast<std::vector<std::byte>*>(data); }
  bool getKey(void*, eprosima::fastrtps::rtps::InstanceHandle_t*, bool) override { return false; }
};

std::uint64_t name_hash(const std::string& process) {
  Fnv1a hash;
  hash.add_text(process);
  hash.add_text("");
  return hash.value();
}

// Greets a process without end, in the name of "talker".
class Talker {
 public:
  Talker(const std::string& run, const std::string& process)
      : participant_(fd::DomainParticipantFactory::get_instance()->create_participant(dds_test_domain(),
                                                                                      on_loopback())) {
    const fd::TypeSupport type(new Octets);
    type.register_type(participant_);
    fd::Topic* const topic = participant_->create_topic("orca-lines/test/" + run + "/" + process,
                                                        type.get_type_name(), fd::TOPIC_QOS_DEFAULT);
    fd::DataWriterQos qos;
    qos.reliability().kind = fd::RELIABLE_RELIABILITY_QOS;
    writer_ = participant_->create_publisher(fd::PUBLISHER_QOS_DEFAULT)->create_datawriter(topic, qos);
    thread_ = std::thread([this] { talk(); });
  }
  ~Talker() {
    ending_ = true;
    thread_.join();
    participant_->delete_contained_entities();
    fd::DomainParticipantFactory::get_instance()->delete_participant(participant_);
  }
  Talker(const Talker&) = delete;
  Talker& operator=(const Talker&) = delete;

  // Returns whether it knows a reader, which is the process it talks to.
  [[nodiscard]] bool has_found() const {
    fd::PublicationMatchedStatus status;
    writer_->get_publication_matched_status(status);
    return status.current_count > 0;
  }

 private:
  void talk() {
    const std::vector<std::byte> greeting = orca::dds::encode({name_hash("talker"), 7, 0, 0, 0});
    std::vector<std::byte> greetings;
    for (int i = 0; i < kGreetings; ++i) greetings.insert(greetings.end(), greeting.begin(), greeting.end());
    while (!ending_) writer_->write(&greetings);
  }

  fd::DomainParticipant* const participant_;
  fd::DataWriter* writer_ = nullptr;
  std::atomic<bool> ending_{false};
  std::thread thread_;
};

struct Publisher : Peer {
  explicit Publisher(Executive& executive) : Peer(executive, "publisher") {}
  PushServer<idl::MotionCommand> out{*this, "out"};
};

}  // namespace

// What comes in just then must not meet a line that is gone; the address sanitizer would tell.
TEST_CASE("a process may leave while another talks to it", "[patterns][dds]") {
  run_on(steady_executives().front(), [](Executive& executive) {
    const std::string run = fresh_run();
    const Talker talker(run, "leaver");
    for (int i = 0; i < part_of(40); ++i) {
      const std::unique_ptr<DdsBackend> leaver = make_dds("leaver", run);
      Publisher publisher(executive);
      REQUIRE(leaver->connect(publisher.endpoint("out"), {"x.in", "talker", {}, 1}, {}, Duration{0}).ok());
      REQUIRE(eventually(executive, [&] { return talker.has_found(); }));
      std::this_thread::sleep_for(200ms);  // while it is talked to
    }
  });
}
