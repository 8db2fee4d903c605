// SPDX-License-Identifier: LGPL-3.0-or-later
#include "mission_book.hpp"

#include <algorithm>
#include <utility>

#include "orca/base/text.hpp"
#include "orca/idl/time.hpp"

namespace orca::supervisor {
namespace {

constexpr std::size_t kLongestText = 500;  // [bytes]

std::string cause_text(const std::string& origin, const std::string& port, std::uint64_t seq) {
  if (origin.empty()) return "";
  return origin + (port.empty() ? "" : "." + port) + " " + std::to_string(seq);
}

}  // namespace

void MissionBook::add(std::uint64_t mission, Event event) {
  if (mission == 0) return;
  Mission& known = missions_[mission];
  if (missions_.size() > kMostMissions) {
    missions_.erase(missions_.begin());
    return add(mission, std::move(event));
  }
  if (known.events.size() == kMostEvents) {
    ++known.left_out;
    return;
  }
  event.text = shortened(event.text, kLongestText);
  const auto place = std::ranges::upper_bound(known.events, event.time, {}, &Event::time);
  known.events.insert(place, std::move(event));
}

void MissionBook::add(const idl::OrcaObject& object, TimePoint time, const std::string& who,
                      const std::string& what, const std::string& text) {
  const idl::Cause& cause = object.cause();
  add(object.mission(), {time, who, what, text, cause_text(cause.origin(), cause.port(), cause.seq())});
}

void MissionBook::note(const MissionStep& step) {
  add(step.mission, {TimePoint(Duration(static_cast<Duration::rep>(step.time))), step.port, "sends",
                     step.type + " " + std::to_string(step.seq),
                     cause_text(step.cause_origin, step.cause_port, step.cause_seq)});
}

void MissionBook::note(const idl::Arrived& arrived) {
  add(arrived, to_time_point(arrived.creation_time()), arrived.origin(), "arrived", arrived.name());
}

void MissionBook::note(const idl::GoalFailed& failed) {
  add(failed, to_time_point(failed.creation_time()), failed.origin(), "failed",
      failed.name() + ": " + failed.reason());
}

void MissionBook::note(const idl::Contact& contact) {
  add(contact, to_time_point(contact.creation_time()), contact.origin(), "contact", contact.other());
}

void MissionBook::note(const idl::Alarm& alarm) {
  add(alarm, to_time_point(alarm.stamp()), alarm.source(), "alarm", kind_text(alarm) + ": " + alarm.text());
}

void MissionBook::show(Reply& reply) const {
  for (const auto& [number, mission] : missions_) {
    const Event& last = mission.events.back();
    reply.add(Record{{"mission", number},
                     {"began", to_seconds(mission.events.front().time - start_), 3},
                     {"events", mission.events.size() + mission.left_out},
                     {"last_time", to_seconds(last.time - start_), 3},
                     {"last", last.what + " " + last.text}});
  }
}

Status MissionBook::show(std::uint64_t mission, Reply& reply) const {
  const auto found = missions_.find(mission);
  if (found == missions_.end())
    return fail(Code::not_found,
                "nothing is known of mission " + std::to_string(mission) + "; see: orcactl missions");
  for (const Event& event : found->second.events)
    reply.add(Record{{"time", to_seconds(event.time - start_), 3},
                     {"who", event.who},
                     {"what", event.what},
                     {"event", event.text},
                     {"cause", event.cause}});
  return ok();
}

}  // namespace orca::supervisor
