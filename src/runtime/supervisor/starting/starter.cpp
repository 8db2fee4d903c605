// SPDX-License-Identifier: LGPL-3.0-or-later
#include "starter.hpp"

#include <algorithm>
#include <chrono>
#include <set>
#include <utility>

#include "agreed/run_wishes.hpp"
#include "orca/base/exhaustion.hpp"
#include "orca/base/log.hpp"
#include "orca/base/steady_clock.hpp"
#include "orca/base/text.hpp"
#include "orca/graph/placement.hpp"
#include "orca/graph/print.hpp"
#include "orca/supervisor/outputs.hpp"
#include "writable_places.hpp"

namespace orca::supervisor {
namespace {

constexpr std::uint64_t kReserved = std::uint64_t{1} << 30;  // [bytes] of stacks and the like

}  // namespace

Starter::Starter(const graph::Graph& graph, const SystemFacts& facts, const SupervisedOptions& options,
                 const RunIdentity& run, Roster& roster)
    : graph_(graph),
      facts_(facts),
      options_(options),
      run_(run),
      roster_(roster),
      doorbells_(run.doorbells),
      wiring_(graph) {}

Starter::Begun Starter::start(const Members& members) {
  Begun begun;
  std::set<std::string> names;
  std::set<std::string> waking;
  for (const Member* member : members) {
    names.insert(member->name());
    if (member->phase() == Member::Phase::asleep) waking.insert(member->name());
  }
  Result<Wiring::Lots> lots = contain_exhaustion([&] { return wiring_.deal(names, waking); });
  for (Member* const member : members) {
    const Status started =
        lots ? contain_exhaustion([&] { return member->start(host_start(*member)); }) : Status(lots.error());
    if (!started.ok()) {
      begun.failed.emplace_back(member, started.error());
      continue;
    }
    begun.members.push_back(member);
    begun.setups.push_back(setup(*member, *lots));
  }
  if (lots) renew_others(members, *lots);
  return begun;
}

Status Starter::renew_edges_of(const Member& member) {
  Result<Wiring::Lots> lots = contain_exhaustion([&] { return wiring_.deal({member.name()}); });
  if (!lots) return lots.error();
  lots->by_process.erase(member.name());
  renew_others({}, *lots);
  return ok();
}

Status Starter::renew_edges(const std::set<std::string>& edges) {
  Result<Wiring::Lots> lots = contain_exhaustion([&] { return wiring_.deal_edges(edges); });
  if (!lots) return lots.error();
  renew_others({}, *lots);
  return ok();
}

void Starter::mend(const std::string& edge, Moment now) {
  constexpr std::size_t kMost = 6;  // Both ends may report the same damage.
  constexpr auto kSpan = std::chrono::minutes(1);
  const auto complain = [&](const std::string& why) {
    log::error(options_.log_name, "the connection " + in_quotes(edge) + " stays cut: " + why);
  };
  std::deque<Moment>& last = mended_[edge];
  while (!last.empty() && now - last.front() > kSpan) last.pop_front();
  if (last.size() >= kMost)
    return complain("its memory was damaged too often; orcactl restart one of its two processes");
  last.push_back(now);
  if (const Status renewed = renew_edges({edge}); !renewed.ok()) complain(renewed.error().text());
}

// The supervisor itself sees to the limit of memory. The system counts what is reserved as well, such as stacks: its
// limit only keeps a process that grows within moments from taking the memory of all others.
HostStart Starter::host_start(const Member& member) const {
  const std::optional<std::uint64_t> memory = member.node().memory;
  return {member.name(),
          options_.program,
          options_.arguments,
          memory ? std::optional(2 * *memory + kReserved) : std::nullopt,
          member.node().processors,
          member.node().priority.value_or(0),
          true,
          places_of(member.name()),
          options_.kept_descriptors};
}

std::vector<std::string> Starter::places_of(const std::string& process) const {
  std::vector<std::string> places = writable_places(graph_, process, facts_, options_.outputs);
  places.insert(places.end(), options_.writable.begin(), options_.writable.end());
  return places;
}

HostStart Starter::plain_start(const std::string& name) const {
  return {name, options_.program, options_.arguments, std::nullopt, {}, 0};
}

// Takes what is the member's out of the lots.
Setup Starter::setup(const Member& member, Wiring::Lots& lots) {
  const RunWishes wishes{
      options_.seed.value_or(1), options_.log_level,        steady_epoch(),      run_.start,
      options_.executor,         options_.planned_failures, outputs_for(member), run_.name};
  return {member.name(),
          graph::print(graph_),
          to_pairs(wishes),
          run_.page.descriptor(),
          std::move(lots.by_process[member.name()]),
          doorbells_,
          states_for(member),
          roster_.places(),
          std::move(lots.pools[member.name()])};
}

std::vector<StateKept> Starter::states_for(const Member& member) {
  std::vector<StateKept> states;
  for (const graph::ComponentNode& node : graph_.components) {
    const auto kept = states_.find(node.name);
    if (node.process != member.name() || kept == states_.end()) continue;
    if (heirs_.erase(node.name) > 0 || node.restore_last) states.push_back(kept->second);
  }
  return states;
}

void Starter::forget_old_states() {
  std::erase_if(states_, [this](const auto& kept) {
    const graph::ComponentNode* const node = graph_.find_component(kept.first);
    return node == nullptr || !node->restore_last;
  });
}

Result<AddComponent> Starter::introduce(const graph::ComponentNode& component) {
  const auto known = std::ranges::find(doorbells_, component.name);
  const auto place = static_cast<std::size_t>(known - doorbells_.begin());
  if (place == run_.page.components())
    return fail(Code::failed_precondition,
                "too many components have come and gone in this run; start the system again", component.name);
  if (known == doorbells_.end()) doorbells_.push_back(component.name);
  if (graph_.find_component(component.name) == nullptr)
    states_.erase(component.name);  // of one that has gone
  const std::map<std::string, std::string> values = graph::print_values(component.params);
  return AddComponent{component, {values.begin(), values.end()}, place};
}

Result<std::vector<NoteProcess>> Starter::introduce_processes(const graph::Graph& graph,
                                                              const std::set<std::string>& processes) {
  if (Status room = roster_.reserve(graph); !room.ok()) return room.error();
  const std::vector<std::string>& places = roster_.places();
  std::vector<NoteProcess> notes;
  for (const graph::ProcessNode& node : graph::processes_on(graph, options_.machine)) {
    if (!processes.contains(node.name)) continue;
    const auto place = static_cast<std::uint64_t>(std::ranges::find(places, node.name) - places.begin());
    notes.push_back({node.name, place, options_.executor.value_or(node.executor) == Backend::fiber});
  }
  return notes;
}

// A process that is started again would overwrite what was written before, and so would one that has come with what another
// one has recorded.
host::RunOutputs Starter::outputs_for(const Member& member) {
  host::RunOutputs outputs = outputs_of(graph_, member.name(), options_.outputs);
  const bool is_first = started_.insert(member.name()).second && !run_.is_inherited && !has_gone_over_;
  if (is_first) return outputs;
  const bool writes =
      !outputs.trace_file.empty() || !outputs.recordings.empty() || !outputs.picture.file.empty();
  if (writes)
    log::warning(member.name(),
                 has_gone_over_
                     ? "begins with another graph than the run; it writes no trace, recordings or picture"
                     : "is started again; its trace, recordings or picture end where it was lost");
  host::RunOutputs none;
  none.looks_on = outputs.looks_on;
  return none;
}

// Gives the processes that run already the other end of the new edges.
void Starter::renew_others(const Members& started, Wiring::Lots& lots) {
  for (Member* const member : roster_.all()) {
    const auto lot = lots.by_process.find(member->name());
    const bool is_new = std::ranges::find(started, member) != started.end();
    if (is_new || lot == lots.by_process.end()) continue;
    for (EdgeMemory& edge : lot->second) member->tell(RenewEdge{std::move(edge)});
  }
}

StartOrder Starter::in_start_order(const Members& members) const {
  StartOrder components;
  for (const std::string& component : graph::start_order(graph_)) {
    const std::string& process = graph_.find_component(component)->process;
    const auto member = std::ranges::find(members, process, [](const Member* m) { return m->name(); });
    if (member != members.end()) components.emplace_back(*member, component);
  }
  return components;
}

std::vector<std::string> Starter::components_of(const Member& member) const {
  std::vector<std::string> names;
  for (const graph::ComponentNode& node : graph_.components)
    if (node.process == member.name()) names.push_back(node.name);
  return names;
}

}  // namespace orca::supervisor
