// SPDX-License-Identifier: GPL-3.0-or-later
// Programs that know nothing of Orca but its IDL files read what a port publishes.
#include <catch2/catch.hpp>

#include <fastdds/dds/domain/DomainParticipant.hpp>
#include <fastdds/dds/domain/DomainParticipantFactory.hpp>
#include <fastdds/dds/subscriber/DataReader.hpp>
#include <fastdds/dds/subscriber/SampleInfo.hpp>
#include <fastdds/dds/subscriber/Subscriber.hpp>
#include <fastdds/dds/topic/Topic.hpp>

#include <string>

#include "dds_links.hpp"
#include "executives.hpp"
#include "on_loopback.hpp"
#include "orca/idl/motion.hpp"
#include "orca/idl/navigation.hpp"
#include "peer.hpp"
#include "reference/motionPubSubTypes.h"
#include "reference/navigationPubSubTypes.h"

using namespace orca;
using namespace orca::test;
namespace fd = eprosima::fastdds::dds;
using eprosima::fastrtps::types::ReturnCode_t;

namespace {

template <class T>
struct Publisher : Peer {
  explicit Publisher(Executive& executive) : Peer(executive, "publisher") {}
  PushServer<T> out{*this, "out"};
};

template <class T>
struct Subscriber : Peer {
  explicit Subscriber(Executive& executive) : Peer(executive, "subscriber") {}
  PushProxy<T> in{*this, "in"};
};

// A bare program that reads the topic of Publisher::out with the type that fastddsgen has generated.
template <class PubSubType>
class BareReader {
 public:
  BareReader()
      : participant_(fd::DomainParticipantFactory::get_instance()->create_participant(dds_test_domain(),
                                                                                      on_loopback())) {
    fd::TypeSupport type(new PubSubType);
    // The classes are in another namespace here, where Orca's own are, too.
    type->setName(("orca" + type.get_type_name().substr(std::string("reference").size())).c_str());
    type.register_type(participant_);
    topic_ =
        participant_->create_topic("orca/test/publisher/out", type.get_type_name(), fd::TOPIC_QOS_DEFAULT);
    reader_ = participant_->create_subscriber(fd::SUBSCRIBER_QOS_DEFAULT)
                  ->create_datareader(topic_, fd::DATAREADER_QOS_DEFAULT);
  }
  ~BareReader() {
    participant_->delete_contained_entities();
    fd::DomainParticipantFactory::get_instance()->delete_participant(participant_);
  }
  BareReader(const BareReader&) = delete;
  BareReader& operator=(const BareReader&) = delete;

  // Takes one sample if there is one.
  bool take(typename PubSubType::type& object) {
    fd::SampleInfo info;
    return reader_->take_next_sample(&object, &info) == ReturnCode_t::RETCODE_OK && info.valid_data;
  }

 private:
  fd::DomainParticipant* const participant_;
  fd::Topic* topic_ = nullptr;
  fd::DataReader* reader_ = nullptr;
};

}  // namespace

TEST_CASE("a bare DDS program reads what a port publishes", "[patterns][dds]") {
  run_on_each(steady_executives(), [](Executive& executive) {
    DdsLinks links(executive);
    Publisher<idl::MotionCommand> publisher(executive);
    Subscriber<idl::MotionCommand> subscriber(executive);
    REQUIRE(links.connect(publisher.endpoint("out"), subscriber.endpoint("in")).ok());
    BareReader<reference::idl::MotionCommandPubSubType> bare;
    subscriber.in.subscribe();
    REQUIRE(eventually(executive, [&] { return publisher.out.subscriber_count() == 1; }));
    reference::idl::MotionCommand read;
    const bool came = eventually(executive, [&] {
      publisher.out.push(head(0.25, 0.5));
      return bare.take(read);
    });
    REQUIRE(came);
    CHECK(read.speed() == 0.5);
    CHECK(read.origin() == "publisher");
    CHECK(read.seq() > 0);
  });
}

TEST_CASE(
    "instants of a publisher whose clock is ahead are set back for a subscriber, and not for a bare program",
    "[patterns][dds]") {
  run_on_each(steady_executives(), [](Executive& executive) {
    constexpr Duration kAhead = 1h;
    DdsLinks links(executive, DdsLinks::Help::task, kAhead);
    Publisher<idl::MotionCommand> publisher(executive);
    Subscriber<idl::MotionCommand> subscriber(executive);
    REQUIRE(links.connect(publisher.endpoint("out"), subscriber.endpoint("in")).ok());
    BareReader<reference::idl::MotionCommandPubSubType> bare;
    subscriber.in.subscribe();
    REQUIRE(eventually(executive, [&] { return publisher.out.subscriber_count() == 1; }));
    const TimePoint begun = executive.now();
    const auto made = [](const idl::MotionCommand& command) {
      return to_time_point(command.creation_time());
    };
    reference::idl::MotionCommand read;
    std::size_t heard = 0;
    const bool came = eventually(executive, [&] {
      publisher.out.push(head(0.25, 0.5));
      if (const auto command = subscriber.in.get_update()) {
        ++heard;
        CHECK(made(*command) >= begun - kAhead);
        CHECK(made(*command) <= executive.now() - kAhead);
      }
      return bare.take(read) && heard > 20;  // by then objects come by the topic alone
    });
    REQUIRE(came);
    idl::TimeValue stamp;
    stamp.ns(read.creation_time().ns());
    CHECK(to_time_point(stamp) >= begun);
  });
}

TEST_CASE("a bare DDS program reads a subtype as what its topic says", "[patterns][dds]") {
  run_on_each(steady_executives(), [](Executive& executive) {
    DdsLinks links(executive);
    Publisher<idl::GoalPoint> publisher(executive);
    Subscriber<idl::GoalPoint> subscriber(executive);
    REQUIRE(links.connect(publisher.endpoint("out"), subscriber.endpoint("in")).ok());
    BareReader<reference::idl::GoalPointPubSubType> bare;
    subscriber.in.subscribe();
    REQUIRE(eventually(executive, [&] { return publisher.out.subscriber_count() == 1; }));
    reference::idl::GoalPoint read;
    const bool came = eventually(executive, [&] {
      Loan<idl::Door> door = make_object<idl::Door>();
      door->name() = "kitchen door";
      door->passable() = true;
      publisher.out.push(std::move(door));
      return bare.take(read);
    });
    REQUIRE(came);
    CHECK(read.name() == "kitchen door");
    const auto door = subscriber.in.get_update().as<idl::Door>();
    REQUIRE(door);
    CHECK(door->passable());  // the subscriber gets all of it
  });
}
