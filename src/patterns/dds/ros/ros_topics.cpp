// SPDX-License-Identifier: LGPL-3.0-or-later
#include "orca/patterns/dds/ros_topics.hpp"

#include <algorithm>
#include <map>
#include <utility>

#include "orca/idl/motion.hpp"
#include "orca/idl/sensing.hpp"
#include "orca/patterns/endpoints/push_client_endpoint.hpp"
#include "orca/patterns/endpoints/push_server_endpoint.hpp"
#include "orca/patterns/endpoints/send_client_endpoint.hpp"
#include "orca/patterns/endpoints/send_server_endpoint.hpp"
#include "orca/ros/cdr.hpp"
#include "ros_ends.hpp"

namespace orca {
namespace {

using namespace dds;
using namespace dds::of_ros;

constexpr int kDepth = 10;  // as ROS has it

const ObjectType& type_of(const Endpoint& port) { return *find_object_type(port.contract().type.name); }

// Returns whether objects say where something is mounted, or how a robot has moved.
bool says_frames(const ObjectType& type) {
  const auto is = [&](const ObjectType& known) { return is_a(type, known); };
  return is(object_type<idl::Odometry>()) || is(object_type<idl::RobotPose>()) ||
         is(object_type<idl::RangeReadings>()) || is(object_type<idl::Image>());
}

// Returns whether messages say something in a sensor's frame, whose place others know.
bool needs_frames(const ObjectType& type) {
  return is_a(type, object_type<idl::RangeReadings>()) || is_a(type, object_type<idl::Image>());
}

// A sensor's messages come again soon, so a writer need not repeat one that was lost; it may not even offer that.
bool is_stream(const ObjectType& type) {
  return needs_frames(type) || is_a(type, object_type<idl::Odometry>()) ||
         is_a(type, object_type<idl::MotionCommand>()) || is_a(type, object_type<idl::Battery>());
}

Unread unread_of(const ObjectType& type, const ros::Twin& twin) {
  if (twin.is_latched) return Unread::all;
  if (needs_frames(type)) return Unread::first;
  return says_frames(type) ? Unread::moves : Unread::nothing;
}

class FastRosTopics final : public RosTopics {
 public:
  explicit FastRosTopics(std::unique_ptr<RosParticipant> participant)
      : participant_(std::move(participant)), frames_(*participant_), outbox_([] {}) {}
  ~FastRosTopics() override { outbox_.end(); }
  FastRosTopics(const FastRosTopics&) = delete;
  FastRosTopics& operator=(const FastRosTopics&) = delete;

  Status open() {
    const RosChannel channel{"ros_discovery_info",
                             std::string(Reflection<ros::rmw_dds_common::ParticipantEntitiesInfo>::name),
                             true,
                             true,
                             1,
                             "nodes"};
    auto writer = participant_->make_writer(channel, [] {});
    if (!writer) return writer.error();
    nodes_writer_ = std::move(writer).value();
    return ok();
  }

  Status connect(Endpoint& port, const RosTopic& topic, const QueuePolicy& policy) override {
    if (Status connected = connect_end(port, topic, policy); !connected.ok()) return connected;
    say_nodes();
    return ok();
  }

 private:
  Status connect_end(Endpoint& port, const RosTopic& topic, const QueuePolicy& policy) {
    if (auto* server = dynamic_cast<PushServerEndpoint*>(&port)) return publish(*server, topic);
    if (auto* client = dynamic_cast<SendClientEndpoint*>(&port)) return publish(*client, topic);
    if (auto* client = dynamic_cast<PushClientEndpoint*>(&port)) return hear(*client, topic, policy);
    if (auto* server = dynamic_cast<SendServerEndpoint*>(&port)) return hear(*server, topic, policy);
    return fail(Code::invalid_argument, port.path() + " is a port of Query, which has no topics");
  }

  static Error no_message(const Endpoint& port, const RosTopic& topic) {
    return fail(Code::invalid_argument, port.path() + " takes or gives " + port.contract().type.name +
                                            ", for which ROS 2 has no " +
                                            (topic.message.empty() ? "message" : topic.message));
  }

  // @param changed  as of make_writer().
  Result<std::shared_ptr<RosPublication>> publication(Endpoint& port, const RosTopic& topic,
                                                      const ros::Twin& twin, std::function<void()> changed) {
    const RosChannel channel{topic.name, std::string(twin.message),    twin.is_latched,
                             true,       twin.is_latched ? 1 : kDepth, port.path()};
    auto writer = participant_->make_writer(channel, std::move(changed));
    if (!writer) return writer.error();
    if (says_frames(type_of(port)))
      if (Status said = frames_.publish(); !said.ok()) return said.error();
    if (is_a(type_of(port), object_type<idl::RobotPose>()))
      if (Status heard = frames_.listen(); !heard.ok()) return heard.error();
    nodes_[port.component()].writers.push_back((*writer)->gid());
    return std::make_shared<RosPublication>(std::move(writer).value(), twin, frames_);
  }

  Status publish(PushServerEndpoint& server, const RosTopic& topic) {
    const ros::Twin* const twin = ros::twin_to_ros(type_of(server), topic.message);
    if (twin == nullptr) return no_message(server, topic);
    Strand& strand = server.home().strand;
    auto bell = std::make_shared<Bell>(strand);
    auto publication = this->publication(server, topic, *twin, [bell] { bell->ring(); });
    if (!publication) return publication.error();
    const Unread unread = unread_of(type_of(server), *twin);
    if (unread == Unread::moves) frames_.add(bell);
    server.adopt(std::make_unique<PushToTopic>(strand, server.connect(topic.name),
                                               std::move(publication).value(), outbox_, std::move(bell),
                                               unread));
    return ok();
  }

  Status publish(SendClientEndpoint& client, const RosTopic& topic) {
    const ros::Twin* const twin = ros::twin_to_ros(type_of(client), topic.message);
    if (twin == nullptr) return no_message(client, topic);
    auto publication = this->publication(client, topic, *twin, [] {});
    if (!publication) return publication.error();
    auto target = std::make_unique<SendToRos>(topic.name, std::move(publication).value(), outbox_);
    client.connect(*target);
    client.adopt(std::move(target));
    return ok();
  }

  Status open_intake(RosIntake& intake, Endpoint& port, const RosTopic& topic, const ros::Twin& twin) {
    if (needs_frames(type_of(port)))
      if (Status heard = frames_.listen(); !heard.ok()) return heard;
    const RosChannel channel{topic.name,
                             std::string(twin.message),
                             twin.is_latched,
                             !is_stream(type_of(port)),
                             twin.is_latched ? 1 : kDepth,
                             port.path()};
    if (Status opened = intake.open(*participant_, channel); !opened.ok()) return opened;
    nodes_[port.component()].readers.push_back(intake.gid());
    return ok();
  }

  Status hear(PushClientEndpoint& client, const RosTopic& topic, const QueuePolicy& policy) {
    const ros::Twin* const twin = ros::twin_from_ros(type_of(client), topic.message);
    if (twin == nullptr) return no_message(client, topic);
    auto end = std::make_unique<RosToPush>(client.home().strand, client.path(), topic.name, *twin, frames_);
    if (Status opened = open_intake(*end, client, topic, *twin); !opened.ok()) return opened;
    client.connect(end->source(), policy);
    client.adopt(std::move(end));
    return ok();
  }

  Status hear(SendServerEndpoint& server, const RosTopic& topic, const QueuePolicy& policy) {
    const ros::Twin* const twin = ros::twin_from_ros(type_of(server), topic.message);
    if (twin == nullptr) return no_message(server, topic);
    auto end = std::make_unique<RosToSend>(server.home().strand, server.path(), topic.name, *twin, frames_);
    end->use(server.connect(topic.name, policy));
    if (Status opened = open_intake(*end, server, topic, *twin); !opened.ok()) return opened;
    server.adopt(std::move(end));
    return ok();
  }

  // Says which components are here, as the middlewares of ROS 2 do for their nodes.
  void say_nodes() {
    const auto to_ros = [](const std::vector<Gid>& gids) {
      std::vector<ros::rmw_dds_common::Gid> all;
      for (const Gid& gid : gids) {
        auto& one = all.emplace_back();
        std::ranges::transform(gid, one.data.begin(),
                               [](std::byte byte) { return std::to_integer<std::uint8_t>(byte); });
      }
      return all;
    };
    ros::rmw_dds_common::ParticipantEntitiesInfo info;
    info.gid = to_ros({participant_->gid()}).front();
    bool frames = true;  // whose writers and readers are listed with the first node
    for (const auto& [component, node] : nodes_) {
      std::vector<Gid> readers = node.readers;
      std::vector<Gid> writers = node.writers;
      if (std::exchange(frames, false)) {
        std::ranges::copy(frames_.readers(), std::back_inserter(readers));
        std::ranges::copy(frames_.writers(), std::back_inserter(writers));
      }
      const std::size_t slash = component.rfind('/');
      const bool alone = slash == std::string::npos;
      info.node_entities_info_seq.push_back({alone ? "/" : "/" + component.substr(0, slash),
                                             alone ? component : component.substr(slash + 1), to_ros(readers),
                                             to_ros(writers)});
    }
    nodes_writer_->write(ros::to_cdr(info));
  }

  // The readers and writers of a component.
  struct Node {
    std::vector<Gid> readers;
    std::vector<Gid> writers;
  };

  const std::unique_ptr<RosParticipant> participant_;
  std::shared_ptr<RosWriter> nodes_writer_;
  std::map<std::string, Node> nodes_;  // by component
  RosFrames frames_;
  Outbox outbox_;  // whose thread uses the frames
};

}  // namespace

extern "C" [[gnu::visibility("default")]] void orca_make_ros_topics(const RosOptions& options,
                                                                    MadeRosTopics& made) {
  Result<std::unique_ptr<RosParticipant>> participant =
      RosParticipant::open({.domain = options.domain, .address = options.only_here ? "127.0.0.1" : ""});
  if (!participant) {
    made.emplace(participant.error());
    return;
  }
  auto topics = std::make_unique<FastRosTopics>(std::move(participant).value());
  if (const Status opened = topics->open(); !opened.ok()) {
    made.emplace(opened.error());
  } else {
    made.emplace(std::move(topics));
  }
}

}  // namespace orca
