// SPDX-License-Identifier: LGPL-3.0-or-later
#include "machines/team_presence.hpp"

#include <utility>

#include "orca/base/log.hpp"
#include "orca/base/steady_clock.hpp"
#include "orca/base/text.hpp"
#include "orca/idl/time.hpp"
#include "orca/supervisor/log_name.hpp"

namespace orca::supervisor {
namespace {

constexpr auto kTeamRepeat = 200ms;
constexpr auto kFarewellPause = 50ms;
constexpr int kFarewells = 3;  // some may be lost

Meet meeting_of(const graph::Graph& graph) {
  Meet meet;
  meet.name = "team";
  meet.type = "orca::idl::TeamState";
  meet.topic = team_topic(graph.team.name);
  meet.interface = graph.team.interface;
  meet.domain = graph.team.domain;
  return meet;
}

std::uint64_t number_of_run() { return static_cast<std::uint64_t>(steady_now().time_since_epoch().count()); }

std::string text_of_offers(const std::vector<idl::TeamOffer>& offers) {
  std::vector<std::string> names;
  for (const idl::TeamOffer& offer : offers) names.push_back(offer.name() + " (" + offer.type() + ")");
  return joined(names, ", ");
}

std::string state_of(const TeamDirectory::Member& member) {
  if (member.has_taken_name) return "has a name twice taken";
  if (member.refused.empty()) return "there";
  return "other type: " +
         joined(std::vector<std::string>(member.refused.begin(), member.refused.end()), ", ");
}

Record line_of(const std::string& system, const std::string& state, Moment::duration since,
               const std::optional<Moment::duration>& silence, const std::vector<idl::TeamOffer>& offers) {
  const auto seconds = [](Moment::duration time) { return std::chrono::duration<double>(time).count(); };
  Cell heard = silence ? Cell("heard_s", seconds(*silence), 1) : Cell("heard_s", "");
  heard.kind = Cell::Kind::number;
  return {{"system", system},
          {"state", state},
          {"since_s", seconds(since), 1},
          heard,
          {"offers", text_of_offers(offers)}};
}

}  // namespace

TeamPresence::TeamPresence(const graph::Graph& graph, HostStart start)
    : team_(graph.team.name),
      directory_(graph.team, graph.name, number_of_run()),
      messenger_(std::move(start), "the team " + graph.team.name, meeting_of(graph),
                 [this](std::span<const std::byte> bytes) {
                   idl::TeamState state;
                   if (object_type<idl::TeamState>().deserialize(bytes, &state).ok())
                     directory_.hear(state, Moment::clock::now());
                 }) {}

void TeamPresence::turn(Moment now) {
  messenger_.turn(now);
  directory_.look(now);
  for (const TeamDirectory::News& news : directory_.take_news())
    log::write(news.is_warning ? log::Level::warning : log::Level::info, kLogName, news.text);
  if (farewells_ == 0 && now >= say_at_) {
    say(false, now);
    say_at_ = now + kTeamRepeat;
  }
}

void TeamPresence::say(bool leaves, Moment now) {
  idl::TeamState state = directory_.state();
  state.leaves(leaves);
  state.seq(++seq_);
  state.creation_time(to_time_value(steady_now()));
  messenger_.say(state, now);
}

bool TeamPresence::take_leave(Moment now) {
  if (farewells_ < kFarewells && messenger_.member().process() != nullptr) {
    if (farewells_ > 0 && now < say_at_) return false;
    say(true, now);
    say_at_ = now + kFarewellPause;
    ++farewells_;
    return false;
  }
  if (now >= say_at_) messenger_.end(now);
  return messenger_.member().process() == nullptr;
}

void TeamPresence::show(Reply& reply) const {
  const Moment now = Moment::clock::now();
  reply.add(line_of(directory_.state().origin(), "this system", now - begun_, std::nullopt,
                    directory_.state().offers()));
  for (const TeamDirectory::Member& member : directory_.members())
    reply.add(
        line_of(member.name, state_of(member), now - member.since, now - member.heard_at, member.offers));
}

}  // namespace orca::supervisor
