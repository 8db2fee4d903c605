// SPDX-License-Identifier: LGPL-3.0-or-later
#include "roster.hpp"

#include <algorithm>
#include <utility>

#include "orca/graph/placement.hpp"

namespace orca::supervisor {

Roster::Roster(const graph::Graph& graph, std::string machine, std::vector<std::string> places)
    : machine_(std::move(machine)), places_(std::move(places)) {
  go_over(graph);
}

Member* Roster::find(const std::string& name) const {
  const auto found = std::ranges::find(all_, name, &Member::name);
  return found == all_.end() ? nullptr : *found;
}

Member* Roster::at_place(std::size_t place) const {
  const auto found = std::ranges::find(all_, place, &Member::place);
  return found == all_.end() ? nullptr : *found;
}

Status Roster::reserve(const graph::Graph& graph) {
  const std::size_t room = places_.size();
  std::vector<std::string> before = places_;
  for (const graph::ProcessNode& node : graph::processes_on(graph, machine_)) (void)place_for(node.name);
  if (places_.size() == room) return ok();
  places_ = std::move(before);
  return fail(Code::failed_precondition,
              "too many processes have come and gone in this run; start the system again");
}

void Roster::go_over(const graph::Graph& graph) {
  const bool is_first = members_.empty();
  all_.clear();
  for (graph::ProcessNode& node : graph::processes_on(graph, machine_)) {
    const auto known =
        std::ranges::find(members_, node.name, [](const auto& member) { return member->name(); });
    if (known != members_.end()) {
      (*known)->go_over(std::move(node), all_.size());
      all_.push_back(known->get());
    } else {
      const std::size_t place = place_for(node.name);
      members_.push_back(std::make_unique<Member>(std::move(node), all_.size(), place, !is_first));
      all_.push_back(members_.back().get());
    }
  }
}

std::size_t Roster::place_for(const std::string& name) {
  auto place = std::ranges::find(places_, name);
  if (place == places_.end()) place = std::ranges::find(places_, "");
  if (place == places_.end()) place = places_.emplace(places_.end());
  *place = name;
  return static_cast<std::size_t>(place - places_.begin());
}

}  // namespace orca::supervisor
