// SPDX-License-Identifier: LGPL-3.0-or-later
#include "machines/team_directory.hpp"

#include <algorithm>

#include "orca/base/text.hpp"

namespace orca::supervisor {
namespace {

constexpr std::size_t kMostTeamOffers = 64;  // of a system

std::string text_of(const std::vector<idl::TeamOffer>& offers) {
  std::vector<std::string> names;
  for (const idl::TeamOffer& offer : offers) names.push_back(offer.name() + " (" + offer.type() + ")");
  return names.empty() ? "nothing" : listed(names);
}

}  // namespace

TeamDirectory::TeamDirectory(const graph::Team& team, std::string system, std::uint64_t run)
    : team_(team), system_(std::move(system)), run_(run) {}

void TeamDirectory::go_over(const graph::Team& team) {
  if (team.ports == team_.ports) return;
  team_.ports = team.ports;
  for (auto& [key, member] : members_) compare_types(member);
}

idl::TeamState TeamDirectory::state() const {
  idl::TeamState state;
  state.origin(system_);
  state.run(run_);
  for (const graph::TeamPort& port : team_.ports) {
    if (!port.offers) continue;
    idl::TeamOffer& offer = state.offers().emplace_back();
    offer.name(port.name);
    offer.type(port.type);
    offer.hash(port.hash);
  }
  return state;
}

// What it says goes into the log.
bool TeamDirectory::is_possible(const idl::TeamState& state) {
  const auto is_good = [](const idl::TeamOffer& offer) {
    return may_be_system(offer.name()) &&
           std::ranges::all_of(offer.type(), [](char c) { return c > ' ' && c <= '~'; }) &&
           offer.type().size() <= 64;
  };
  return may_be_system(state.origin()) && state.offers().size() <= kMostTeamOffers &&
         std::ranges::all_of(state.offers(), is_good);
}

void TeamDirectory::hear(const idl::TeamState& state, Moment now) {
  if (!is_possible(state)) return;
  const Key key{state.origin(), state.run()};
  if (key == Key{system_, run_}) return;
  const auto known = members_.find(key);
  if (state.leaves()) {
    if (known != members_.end()) leave(known, "has left");
    return;
  }
  if (known == members_.end()) return enter(state, now);
  compare_names(key, now);
  known->second.heard_at = now;
  if (known->second.offers == state.offers()) return;
  known->second.offers = state.offers();
  tell(false, known->second.name + " offers " + text_of(known->second.offers) + " from now on");
  compare_types(known->second);
}

void TeamDirectory::enter(const idl::TeamState& state, Moment now) {
  if (members_.size() >= kMostMembers) return;
  Member& member = members_[{state.origin(), state.run()}];
  member = {state.origin(), now, now, state.offers(), {}, false};
  tell(false, member.name + " is in the team " + team_.name + ", and offers " + text_of(member.offers));
  compare_types(member);
}

void TeamDirectory::leave(std::map<Key, Member>::iterator member, const std::string& how) {
  const std::string name = member->second.name;
  tell(false, name + " " + how + " the team " + team_.name);
  members_.erase(member);
  const auto others =
      std::ranges::count_if(members_, [&](const auto& one) { return one.first.first == name; });
  if (others + (name == system_ ? 1 : 0) < 2) taken_.erase(name);
  for (auto& [key, other] : members_)
    if (other.name == name) other.has_taken_name = taken_.contains(name);
}

// A system that was started again has a new run, and its old one is heard no more. So two have one name if an older run is heard after
// the younger one.
void TeamDirectory::compare_names(const Key& key, Moment now) {
  constexpr auto kUnderWay = std::chrono::milliseconds(400);  // Longer than what a run has said last may be.
  const auto& [name, run] = key;
  Member& member = members_.at(key);
  bool is_taken = name == system_ && now > member.since + kUnderWay;
  for (auto& [other_key, other] : members_)
    if (other_key.first == name && other_key.second != run && other.since >= member.since &&
        now > other.since + kUnderWay)
      is_taken = other.has_taken_name = true;
  if (!is_taken) return;
  member.has_taken_name = true;
  if (!taken_.insert(name).second) return;
  tell(true, name == system_ ? "another system of the team " + team_.name + " is called " + name +
                                   ", too; give one of them another name (--name)"
                             : "two systems of the team " + team_.name + " are called " + name +
                                   "; give one of them another name (--name)");
}

void TeamDirectory::compare_types(Member& member) {
  member.refused.clear();
  for (const idl::TeamOffer& offer : member.offers) {
    const auto here = std::ranges::find(team_.ports, offer.name(), &graph::TeamPort::name);
    if (here == team_.ports.end() || here->hash == offer.hash()) continue;
    member.refused.insert(offer.name());
    const std::string types = here->type == offer.type()
                                  ? "another " + offer.type() + " than this system has"
                                  : offer.type() + ", and this system has " + here->type;
    tell(true,
         member.name + " offers " + offer.name() + " to the team as " + types +
             ": neither hears the other one's; run the same version of Orca and the same graph on both");
  }
}

void TeamDirectory::look(Moment now) {
  for (auto member = members_.begin(); member != members_.end();) {
    const auto next = std::next(member);
    if (now > member->second.heard_at + kLossLimit) leave(member, "is lost from");
    member = next;
  }
}

std::vector<TeamDirectory::Member> TeamDirectory::members() const {
  std::vector<Member> all;
  for (const auto& [key, member] : members_) all.push_back(member);
  return all;
}

}  // namespace orca::supervisor
