// SPDX-License-Identifier: LGPL-3.0-or-later
// The ends of ports that speak to a team.
#pragma once

#include <cstdint>
#include <memory>
#include <set>
#include <span>
#include <string>
#include <utility>

#include "dds/ros/topic_ends.hpp"
#include "orca/idl/machines.hpp"
#include "orca/patterns/dds/team_topics.hpp"
#include "senders.hpp"

namespace orca::dds::of_team {

/// The topic on which a port offers something to a team.
///
/// Thread contract: as TopicPublication.
class TeamPublication final : public of_ros::TopicPublication {
 public:
  TeamPublication(std::shared_ptr<of_ros::RosWriter> writer, std::string system, std::uint64_t run,
                  Executive& clock)
      : TopicPublication(std::move(writer)), system_(std::move(system)), run_(run), clock_(clock) {}

  using TopicPublication::write;
  bool write(const ObjectRef& object, std::size_t size, const Label& label) override;

 private:
  const std::string system_;
  const std::uint64_t run_;
  Executive& clock_;
  std::uint64_t seq_ = 0;
};

/// The server of a PushProxy that hears what the other systems of a team offer.
///
/// Thread contract: as TopicIntake.
class TeamToPush final : public of_ros::TopicIntake, public LinkEnd {
 public:
  /// @param user  the port, for people.   @param wanted  its type.
  TeamToPush(Strand& strand, std::string user, const std::string& offer, const ObjectType& wanted,
             const TeamOptions& here)
      : TopicIntake(strand, std::move(user), offer),
        wanted_(wanted),
        system_(here.system),
        run_(here.run),
        source_(strand, "team." + offer) {}
  ~TeamToPush() override { close(); }
  [[nodiscard]] PushSource& source() { return source_; }

 private:
  ObjectRef read(std::span<const std::byte> payload, TimePoint now) override;
  Result<ObjectRef> object_of(const idl::TeamObject& sent, TimePoint now);
  void complain(const std::string& sender, const std::string& text);
  void pass_on(ObjectRef object) override { source_.pass_on(std::move(object)); }
  void pass_on_losses(std::uint64_t objects) override { source_.pass_on_losses(objects); }

  const ObjectType& wanted_;
  const std::string system_;
  const std::uint64_t run_;
  idl::TeamObject sent_;  // used by the reader's callback, as the next two
  Senders senders_;
  std::set<std::string> complained_;  // of which systems
  of_ros::TopicSource source_;
};

}  // namespace orca::dds::of_team
