// SPDX-License-Identifier: GPL-3.0-or-later
// Anybody in the network may write to a topic of ROS 2 or of a team, and say on /tf where what is: messages become objects of the port's
// type, or are dropped. The first byte chooses the topic; the rest is a sequence of messages: on which topic (1 byte), the length
// (2 bytes), and the fields without the encapsulation.
#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "dds/ros/ros_ends.hpp"
#include "dds/team/team_ends.hpp"
#include "orca/base/log.hpp"
#include "orca/ros/cdr.hpp"
#include "topic_kinds.hpp"

namespace {

using namespace orca;
using namespace orca::dds;
using namespace orca::dds::of_ros;
using of_team::TeamToPush;
using Bytes = std::span<const std::byte>;

// A participant whose readers get what the input says.
class Network final : public RosParticipant {
 public:
  Result<std::shared_ptr<RosWriter>> make_writer(const RosChannel& /*channel*/,
                                                 std::function<void()> /*changed*/) override {
    return fail(Code::unavailable, "nothing is written");
  }
  Result<std::unique_ptr<RosReader>> make_reader(const RosChannel& channel, Received received) override {
    received_[channel.name] = std::move(received);
    return std::unique_ptr<RosReader>(std::make_unique<Reader>());
  }
  [[nodiscard]] Gid gid() const override { return {}; }

  // Lets a message come, with the encapsulation that the type of all topics has checked.
  void say(const std::string& topic, Bytes fields) {
    std::vector<std::byte> payload(ros::kEncapsulation);
    std::ranges::copy(ros::kPlainCdr, payload.begin());
    payload.insert(payload.end(), fields.begin(), fields.end());
    received_.at(topic)(payload);
  }

 private:
  struct Reader final : RosReader {
    [[nodiscard]] Gid gid() const override { return {}; }
  };
  std::map<std::string, Received> received_;
};

// The component at the end of a topic.
class Component final : public PushSink, public SendTarget {
 public:
  explicit Component(const ObjectType& wanted) : wanted_(wanted) {}

  std::optional<Duration> deliver(ObjectRef&& object) override { return take(object), std::nullopt; }
  void give_up(const ObjectRef& /*object*/) override {}
  void granted(const UpdateGrant& /*grant*/) override {}
  void lost(std::uint64_t /*objects*/) override {}

  std::optional<Status> offer(const ObjectRef& object, SendReplySink& /*reply_to*/, RequestId /*id*/,
                              bool /*may_wait*/) override {
    take(object);
    return ok();
  }
  void withdraw(RequestId /*id*/) override {}
  [[nodiscard]] Duration patience() const override { return Duration{0}; }
  [[nodiscard]] std::string path() const override { return "component.port"; }

 private:
  void take(const ObjectRef& object) const {
    if (!is_a(object.type(), wanted_)) std::abort();
    std::vector<std::byte> payload;
    object.type().serialize(object.get(), payload);
    ObjectLoan again = make_object(object.type());
    if (!object.type().deserialize(payload, again.get()).ok()) std::abort();
  }

  const ObjectType& wanted_;
};

void feed(Network& network, Strand& strand, const std::string& topic, Bytes rest) {
  constexpr std::size_t kHead = 3;
  const std::array<std::string, 4> topics{topic, topic, "/tf", "/tf_static"};
  while (rest.size() >= kHead) {
    const std::size_t length = std::min(rest.size() - kHead, std::to_integer<std::size_t>(rest[1]) |
                                                                 std::to_integer<std::size_t>(rest[2]) << 8);
    network.say(topics[std::to_integer<unsigned>(rest[0]) % topics.size()], rest.subspan(kHead, length));
    strand.take_in();
    rest = rest.subspan(kHead + length);
  }
}

void run(Executive& executive, unsigned choice, Bytes input) {
  Strand strand(executive, {"component", 0});
  Network network;
  RosFrames frames(network);
  if (!frames.listen().ok()) std::abort();
  const test::TopicKind kind = test::topic_kinds()[choice % test::topic_kinds().size()];
  const RosChannel channel{kind.name, "", false, false, 1, "component.port"};
  Component component(kind.object);
  if (kind.twin == nullptr) {
    TeamToPush end(strand, "component.port", kind.name, kind.object, {"lab", "anna", 1});
    if (!end.open(network, channel).ok()) std::abort();
    end.source().attach(component, {});
    feed(network, strand, kind.name, input);
  } else if (choice / test::topic_kinds().size() % 2 == 0) {
    RosToPush end(strand, "component.port", kind.name, *kind.twin, frames);
    if (!end.open(network, channel).ok()) std::abort();
    end.source().attach(component, {});
    feed(network, strand, kind.name, input);
  } else {
    RosToSend end(strand, "component.port", kind.name, *kind.twin, frames);
    end.use(component);
    if (!end.open(network, channel).ok()) std::abort();
    feed(network, strand, kind.name, input);
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size == 0) return 0;
  log::set_level(log::Level::error);  // what is dropped is a warning
  static const auto executive = make_executive({}).value();
  executive->run([&] { run(*executive, data[0], std::as_bytes(std::span(data + 1, size - 1))); });
  return 0;
}
