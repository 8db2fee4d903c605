// SPDX-License-Identifier: GPL-3.0-or-later
// What Orca asks of Fast DDS, with Fast DDS: samples, what accompanies them, and whom a topic knows.
#include "dds/backend/participant.hpp"

#include <catch2/catch.hpp>

#include <fastdds/rtps/transport/UDPv4TransportDescriptor.h>
#include <fastdds/dds/domain/DomainParticipant.hpp>
#include <fastdds/dds/domain/DomainParticipantFactory.hpp>
#include <fastdds/dds/publisher/DataWriter.hpp>
#include <fastdds/dds/publisher/Publisher.hpp>
#include <fastdds/dds/subscriber/DataReader.hpp>
#include <fastdds/dds/subscriber/Subscriber.hpp>
#include <fastdds/dds/topic/Topic.hpp>

#include <chrono>
#include <cstring>
#include <mutex>
#include <thread>

#include "dds/backend/participant_qos.hpp"
#include "dds/backend/raw_type.hpp"
#include "dds_links.hpp"
#include "on_loopback.hpp"
#include "orca/idl/motion.hpp"

using namespace orca;
using namespace orca::dds;
using namespace orca::test;
namespace fd = eprosima::fastdds::dds;
using Payload = eprosima::fastrtps::rtps::SerializedPayload_t;
using RawBytes = std::vector<std::byte>;

namespace {

constexpr const char* kType = "orca::dds::Message";

ObjectRef some_command() { return ObjectRef(head(0.5, 2.0).seal()); }

std::size_t size_of(const ObjectRef& object) { return object.type().write(object.get(), {}); }

std::unique_ptr<Participant> opened(const std::string& process) {
  DdsOptions options;
  options.graph = "participants";
  options.process = process;
  options.domain = dds_test_domain();
  return Participant::open(options).value();
}

bool soon(const std::function<bool()>& condition) {
  const auto limit = std::chrono::steady_clock::now() + std::chrono::seconds(10);
  while (!condition()) {
    if (std::chrono::steady_clock::now() > limit) return false;
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
  return true;
}

// Keeps what a reader has received.
class Inbox {
 public:
  void take(Sample sample) {
    const std::lock_guard lock(mutex_);
    samples_.push_back(std::move(sample));
  }
  [[nodiscard]] std::vector<Sample> samples() const {
    const std::lock_guard lock(mutex_);
    return samples_;
  }

 private:
  mutable std::mutex mutex_;
  std::vector<Sample> samples_;
};

// Another program's writer and reader of a topic, which know with whom they are matched.
class Bystander {
 public:
  explicit Bystander(const std::string& topic)
      : participant_(fd::DomainParticipantFactory::get_instance()->create_participant(dds_test_domain(),
                                                                                      on_loopback())) {
    const fd::TypeSupport type(new RawType(kType));
    type.register_type(participant_);
    fd::Topic* const made = participant_->create_topic(topic, kType, fd::TOPIC_QOS_DEFAULT);
    reader_ =
        participant_->create_subscriber(fd::SUBSCRIBER_QOS_DEFAULT)->create_datareader(made, reader_qos(1));
    writer_ = participant_->create_publisher(fd::PUBLISHER_QOS_DEFAULT)
                  ->create_datawriter(made, writer_qos({"", "", 1}));
  }
  ~Bystander() {
    participant_->delete_contained_entities();
    fd::DomainParticipantFactory::get_instance()->delete_participant(participant_);
  }
  Bystander(const Bystander&) = delete;
  Bystander& operator=(const Bystander&) = delete;

  // Both besides its own.
  [[nodiscard]] int writers() const {
    fd::SubscriptionMatchedStatus status;
    reader_->get_subscription_matched_status(status);
    return status.current_count - 1;
  }
  [[nodiscard]] int readers() const {
    fd::PublicationMatchedStatus status;
    writer_->get_publication_matched_status(status);
    return status.current_count - 1;
  }

 private:
  fd::DomainParticipant* const participant_;
  fd::DataReader* reader_ = nullptr;
  fd::DataWriter* writer_ = nullptr;
};

}  // namespace

TEST_CASE("an object arrives with its label, its writer's identity and a number that grows by one",
          "[patterns][dds]") {
  const auto here = opened("here"), there = opened("there");
  Inbox inbox;
  std::atomic<int> found{0};
  const auto reader =
      there->make_reader({"labels", kType, 10}, [&](Sample sample) { inbox.take(std::move(sample)); })
          .value();
  const auto writer = here->make_writer({"labels", kType, 10, [&] { ++found; }}).value();
  REQUIRE(soon([&] { return found == 1; }));
  const ObjectRef object = some_command();
  const Label label{object.type().layout_hash, (std::uint64_t{1} << 61) | 5U, 7};
  CHECK(writer->write(object, size_of(object), label));
  CHECK(writer->write(RawBytes(4, std::byte{9})));
  REQUIRE(soon([&] { return inbox.samples().size() == 2; }));
  const std::vector<Sample> samples = inbox.samples();
  CHECK(samples[0].label.layout_hash == label.layout_hash);
  CHECK(samples[0].label.edges == label.edges);
  CHECK(samples[0].label.epoch == label.epoch);
  RawBytes written(size_of(object));
  (void)object.type().write(object.get(), written);
  CHECK(std::ranges::equal(samples[0].contents(), written));
  CHECK(samples[0].bytes.size() == kHeadroom + written.size());
  CHECK(samples[0].sequence == 1);
  CHECK(samples[1].sequence == 2);
  CHECK(samples[1].origin == samples[0].origin);
  CHECK(samples[1].origin != Origin{});
  CHECK(samples[1].label.edges == 0);  // a message has none
  CHECK(samples[1].label.epoch == 0);
  CHECK(samples[1].label.layout_hash == 0);
  CHECK(RawBytes(samples[1].contents().begin(), samples[1].contents().end()) ==
        RawBytes{std::byte{4}, {}, {}, {}, std::byte{9}, std::byte{9}, std::byte{9}, std::byte{9}});
}

TEST_CASE("a reader hears that a writer was found, and not that it has gone", "[patterns][dds]") {
  const auto here = opened("here"), there = opened("there");
  std::atomic<int> found{0};
  const auto reader = there->make_reader({"found", kType, 1, [&] { ++found; }}, [](const Sample&) {}).value();
  const Bystander bystander("found");
  REQUIRE(soon([&] { return found == 1 && bystander.readers() == 1; }));
  {
    const auto writer = here->make_writer({"found", kType, 1}).value();
    REQUIRE(soon([&] { return found == 2 && bystander.writers() == 1; }));
  }
  REQUIRE(soon([&] { return bystander.writers() == 0; }));
  CHECK(found == 2);
}

TEST_CASE(
    "writers and readers are gone for others as soon as they are destroyed, and their topic can be used "
    "again",
    "[patterns][dds]") {
  const auto here = opened("here");
  const Bystander bystander("gone");
  for (int i = 0; i < 2; ++i) {
    auto first = here->make_writer({"gone", kType, 1}).value();
    auto second = here->make_writer({"gone", kType, 1}).value();
    auto reader = here->make_reader({"gone", kType, 1}, [](const Sample&) {}).value();
    REQUIRE(soon([&] { return bystander.writers() == 2 && bystander.readers() == 1; }));
    first.reset();
    CHECK(soon([&] { return bystander.writers() == 1; }));
    second.reset();
    reader.reset();
    CHECK(soon([&] { return bystander.writers() == 0 && bystander.readers() == 0; }));
  }
}

// The reminders are so frequent that many fall into the deletion, in which Fast DDS 2.9 hangs if there are samples left.
TEST_CASE("a writer is destroyed while its samples are on their way", "[patterns][dds]") {
  constexpr int kSamples = 500;
  const auto here = opened("here"), there = opened("there");
  const auto reader = there->make_reader({"leaving", kType, 1}, [](const Sample&) {}).value();
  for (int i = 0; i < 100; ++i) {
    std::atomic<bool> found{false};
    auto writer =
        here->make_writer({"leaving", kType, kSamples, [&] { found = true; }, std::chrono::microseconds(20)})
            .value();
    REQUIRE(soon([&] { return found.load(); }));
    for (int k = 0; k < kSamples; ++k) REQUIRE(writer->write(RawBytes(4)));
    writer.reset();
  }
}

TEST_CASE("a sample is plain little-endian CDR behind its encapsulation", "[patterns][dds]") {
  RawType type(kType);
  const ObjectRef object = some_command();
  Outgoing outgoing{&object, {}, size_of(object)};
  const auto whole = static_cast<std::uint32_t>(4 + outgoing.size);
  CHECK(type.getSerializedSizeProvider(&outgoing)() == whole);
  Payload small(whole - 1);
  CHECK_FALSE(type.serialize(&outgoing, &small));
  Payload payload(whole);
  REQUIRE(type.serialize(&outgoing, &payload));
  CHECK(payload.length == whole);
  CHECK(std::memcmp(payload.data, "\0\1\0\0", 4) == 0);
  RawBytes read(99);
  REQUIRE(type.deserialize(&payload, &read));
  RawBytes written(outgoing.size);
  (void)object.type().write(object.get(), written);
  REQUIRE(read.size() == kHeadroom + written.size());
  CHECK(std::equal(written.begin(), written.end(), read.begin() + kHeadroom));
}

TEST_CASE("a sample of another encoding, or without one, is discarded", "[patterns][dds]") {
  RawType type(kType);
  RawBytes read;
  const auto reads = [&](const std::vector<unsigned char>& bytes) {
    Payload payload(16);
    std::memcpy(payload.data, bytes.data(), bytes.size());
    payload.length = static_cast<std::uint32_t>(bytes.size());
    return type.deserialize(&payload, &read);
  };
  CHECK(reads({0, 1, 0, 0}));
  CHECK(read.size() == kHeadroom);
  CHECK(reads({0, 1, 7, 7, 5}));  // options mean nothing to a reader
  CHECK(read.size() == kHeadroom + 1);
  CHECK(read.back() == std::byte{5});
  CHECK_FALSE(reads({0, 1, 0}));
  CHECK_FALSE(reads({0, 0, 0, 0, 5}));  // big-endian
  CHECK_FALSE(reads({0, 7, 0, 0, 5}));  // XCDR2
}

TEST_CASE(
    "a process uses the interface that it is given, or all, and asks the other machines that it is told of",
    "[patterns][dds]") {
  using Udp = eprosima::fastdds::rtps::UDPv4TransportDescriptor;
  DdsOptions options;
  options.graph = "robot";
  options.process = "main";
  options.address = "10.0.0.7";
  options.others = {"10.0.0.8", "10.0.0.9"};
  const auto interfaces_of = [](const fd::DomainParticipantQos& qos) {
    REQUIRE(qos.transport().user_transports.size() == 1);
    CHECK_FALSE(qos.transport().use_builtin_transports);  // no shared memory
    return dynamic_cast<const Udp&>(*qos.transport().user_transports[0]).interfaceWhiteList;
  };
  const fd::DomainParticipantQos named = participant_qos(options);
  CHECK(interfaces_of(named) == std::vector<std::string>{"10.0.0.7"});
  CHECK(named.wire_protocol().builtin.initialPeersList.size() == 2);
  CHECK(std::string(named.name().c_str()) == "robot/main");
  options.address.clear();
  options.others.clear();
  CHECK(interfaces_of(participant_qos(options)).empty());
  CHECK(participant_qos(options).wire_protocol().builtin.initialPeersList.empty());
}

TEST_CASE("a topic keeps the last samples, as many as it is told, and repeats those that were lost",
          "[patterns][dds]") {
  const auto check_kept = [](const auto& qos) {
    CHECK(qos.history().kind == fd::KEEP_LAST_HISTORY_QOS);
    CHECK(qos.history().depth == 7);
    CHECK(qos.resource_limits().max_samples == 7);
    CHECK(qos.resource_limits().max_instances == 1);
    CHECK(qos.reliability().kind == fd::RELIABLE_RELIABILITY_QOS);
    CHECK(qos.durability().kind == fd::VOLATILE_DURABILITY_QOS);
  };
  check_kept(writer_qos({"", "", 7}));
  check_kept(reader_qos(7));
}
