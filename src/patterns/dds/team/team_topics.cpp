// SPDX-License-Identifier: LGPL-3.0-or-later
#include "orca/patterns/dds/team_topics.hpp"

#include <utility>

#include "orca/patterns/endpoints/push_client_endpoint.hpp"
#include "orca/patterns/endpoints/push_server_endpoint.hpp"
#include "team_ends.hpp"

namespace orca {
namespace {

using namespace dds;
using namespace dds::of_team;
using of_ros::Bell;
using of_ros::ParticipantOptions;
using of_ros::PushToTopic;
using of_ros::RosChannel;
using of_ros::RosParticipant;
using of_ros::Unread;

class FastTeamTopics final : public TeamTopics {
 public:
  FastTeamTopics(std::unique_ptr<RosParticipant> participant, TeamOptions options)
      : participant_(std::move(participant)), options_(std::move(options)), outbox_([] {}) {}
  ~FastTeamTopics() override { outbox_.end(); }
  FastTeamTopics(const FastTeamTopics&) = delete;
  FastTeamTopics& operator=(const FastTeamTopics&) = delete;

  Status connect(Endpoint& port, const std::string& offer, const QueuePolicy& policy) override {
    if (auto* server = dynamic_cast<PushServerEndpoint*>(&port)) return publish(*server, offer);
    if (auto* client = dynamic_cast<PushClientEndpoint*>(&port)) return hear(*client, offer, policy);
    return fail(Code::invalid_argument, port.path() + " is no port of Push, and only those speak to a team");
  }

 private:
  // Lost objects are not repeated: a robot says of itself the same again.
  [[nodiscard]] RosChannel channel(const Endpoint& port, const std::string& offer) const {
    constexpr int kKept = 16;  // by a writer and by a reader
    return {team_topic(options_.team, offer), "orca::idl::TeamObject", false, false, kKept, port.path()};
  }

  Status publish(PushServerEndpoint& server, const std::string& offer) {
    Strand& strand = server.home().strand;
    auto bell = std::make_shared<Bell>(strand);
    auto writer = participant_->make_writer(channel(server, offer), [bell] { bell->ring(); });
    if (!writer) return writer.error();
    auto publication = std::make_shared<TeamPublication>(std::move(writer).value(), options_.system,
                                                         options_.run, strand.executive());
    server.adopt(std::make_unique<PushToTopic>(strand, server.connect("team." + offer),
                                               std::move(publication), outbox_, std::move(bell),
                                               Unread::nothing));
    return ok();
  }

  Status hear(PushClientEndpoint& client, const std::string& offer, const QueuePolicy& policy) {
    const ObjectType& wanted = *find_object_type(client.contract().type.name);
    auto end = std::make_unique<TeamToPush>(client.home().strand, client.path(), offer, wanted, options_);
    if (Status opened = end->open(*participant_, channel(client, offer)); !opened.ok()) return opened;
    client.connect(end->source(), policy);
    client.adopt(std::move(end));
    return ok();
  }

  const std::unique_ptr<RosParticipant> participant_;
  const TeamOptions options_;
  Outbox outbox_;
};

}  // namespace

extern "C" [[gnu::visibility("default")]] void orca_make_team_topics(const TeamOptions& options,
                                                                     MadeTeamTopics& made) {
  const ParticipantOptions where{options.domain, options.address, "orca team " + options.team, ""};
  Result<std::unique_ptr<RosParticipant>> participant = RosParticipant::open(where);
  if (!participant) {
    made.emplace(participant.error());
    return;
  }
  made.emplace(std::make_unique<FastTeamTopics>(std::move(participant).value(), options));
}

}  // namespace orca
