// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "orca/base/result.hpp"
#include "orca/base/time.hpp"
#include "orca/idl/navigation.hpp"
#include "orca/idl/sensing.hpp"
#include "orca/idl/system.hpp"
#include "orca/supervisor/vocabulary.hpp"
#include "reply.hpp"

namespace orca::supervisor {

/// What has happened in each mission, in the order of its times: which ports have sent something for it, arrivals, failures,
/// contacts, alarms. Objects name their mission; what has none is not kept.
///
/// Thread contract: the supervisor's thread.
class MissionBook {
 public:
  static constexpr std::size_t kMostMissions = 100;  ///< The oldest is given up for a new one.
  static constexpr std::size_t kMostEvents = 500;    ///< Of a mission; later ones are only counted.

  /// @param start  time of the run from which people count.
  explicit MissionBook(TimePoint start) : start_(start) {}

  void note(const MissionStep& step);
  void note(const idl::Arrived& arrived);
  void note(const idl::GoalFailed& failed);
  void note(const idl::Contact& contact);
  void note(const idl::Alarm& alarm);

  /// Answers with a line for each mission.
  void show(Reply& reply) const;
  /// Answers with what happened in a mission.
  /// @errors  not_found.
  Status show(std::uint64_t mission, Reply& reply) const;

 private:
  struct Event {
    TimePoint time;
    std::string who;
    std::string what;
    std::string text;
    std::string cause;
  };
  struct Mission {
    std::vector<Event> events;  // in the order of their times
    std::uint64_t left_out = 0;
  };
  void add(const idl::OrcaObject& object, TimePoint time, const std::string& who, const std::string& what,
           const std::string& text);
  void add(std::uint64_t mission, Event event);

  const TimePoint start_;
  std::map<std::uint64_t, Mission> missions_;
};

}  // namespace orca::supervisor
