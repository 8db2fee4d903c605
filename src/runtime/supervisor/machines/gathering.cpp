// SPDX-License-Identifier: LGPL-3.0-or-later
#include "machines/gathering.hpp"

#include <algorithm>
#include <utility>

#include "orca/base/hash.hpp"
#include "orca/graph/placement.hpp"
#include "orca/graph/print.hpp"
#include "orca/xml/number.hpp"

namespace orca::supervisor {
namespace {

using NewsKind = Gathering::News::Kind;

std::uint64_t hash_of(const graph::Graph& graph) {
  Fnv1a hash;
  hash.add_text(graph::print(graph));
  return hash.value();
}

std::string name_of(const std::string& machine) { return "machine " + machine; }

}  // namespace

Gathering::Gathering(const graph::Graph& graph, std::string here, std::uint64_t run)
    : here_(std::move(here)) {
  own_.origin(here_);
  own_.run(run);
  own_.graph(hash_of(graph));
  for (const graph::MachineNode& node : graph.machines)
    if (node.name != here_ && !graph::processes_on(graph, node.name).empty()) peers_.push_back({node});
  std::map<std::string, std::uint64_t> before;
  for (const std::string& component : graph::start_order(graph)) {
    before_[component] = before;
    ++before[graph::machine_of(graph, component)];
  }
  components_ = before[here_];
}

void Gathering::enter(idl::MachinePhase phase) {
  if (phase > own_.phase()) own_.phase(phase);
}

void Gathering::end(idl::MachineEnd end, const std::string& why) {
  if (own_.phase() == idl::MACHINE_ENDED) return;
  enter(idl::MACHINE_ENDED);
  own_.end(end);
  own_.why(why);
}

bool Gathering::hear(const idl::MachineState& state, Moment now) {
  if (state.origin() == here_) return hear_namesake(state), false;
  const auto peer =
      std::ranges::find(peers_, state.origin(), [](const Peer& known) { return known.node.name; });
  if (peer == peers_.end()) return false;
  if (state.graph() != own_.graph()) return refuse(*peer, state), false;
  if (!is_later(*peer, state)) return false;
  const bool is_new = !peer->said || peer->said->run() != state.run();
  if (is_new && own_.phase() == idl::MACHINE_ENDED) return false;
  tell_arrival(*peer, state);
  peer->said = state;
  peer->heard_at = now;
  peer->lost = false;
  peer->refused.reset();
  if (state.phase() == idl::MACHINE_ENDED && has_heard_us(state)) hear_end(*peer);
  return true;
}

// Two deployers for one machine: the one that is further, or was started earlier, stays. A single state may be the last
// one of a run that was killed a moment ago.
void Gathering::hear_namesake(const idl::MachineState& state) {
  const bool is_ours = state.run() == own_.run() || state.phase() == idl::MACHINE_ENDED;
  if (is_ours || own_.phase() != idl::MACHINE_GATHERING) return;
  if (std::exchange(namesake_, state.run()) != state.run()) return;
  if (state.phase() > idl::MACHINE_GATHERING || state.run() < own_.run())
    decide(idl::MACHINE_NOT_STARTED,
           "another deployer runs this graph as " + name_of(here_) + "; give each --machine once");
}

void Gathering::refuse(Peer& peer, const idl::MachineState& state) {
  if (peer.refused == state.run() && has_heard_us(state)) peer.knows_refusal = true;
  const bool is_past = state.phase() == idl::MACHINE_ENDED && !has_heard_us(state);
  if (is_past || own_.phase() == idl::MACHINE_ENDED || peer.refused == state.run()) return;
  peer.refused = state.run();
  peer.knows_refusal = has_heard_us(state);
  const std::string text = name_of(here_) + " and " + name_of(peer.node.name) + " run different graphs";
  if (own_.phase() == idl::MACHINE_GATHERING)
    return decide(idl::MACHINE_NOT_STARTED,
                  text + "; start both with the same files, --profile and --set (--print shows the graph)");
  tell(NewsKind::warning, text + ", so " + name_of(peer.node.name) + " stays out");
}

bool Gathering::is_later(const Peer& peer, const idl::MachineState& state) const {
  if (!peer.said) return true;
  if (peer.said->run() == state.run()) return state.seq() > peer.said->seq();
  return state.run() > peer.said->run() || peer.lost || peer.said->phase() == idl::MACHINE_ENDED;
}

// Reports that a machine is there, or there again.
void Gathering::tell_arrival(Peer& peer, const idl::MachineState& state) {
  if (state.phase() == idl::MACHINE_ENDED) return;
  const bool is_known = peer.said && peer.said->run() == state.run();
  if (is_known && !peer.lost) return;
  if (own_.phase() == idl::MACHINE_GATHERING) return tell(NewsKind::info, title(peer) + " is there");
  tell(peer.lost ? NewsKind::back : NewsKind::info,
       title(peer) + (is_known ? " is heard again" : " was started again"), peer.node.name);
}

void Gathering::hear_end(Peer& peer) {
  const idl::MachineState& said = *peer.said;
  const std::string why = said.why().empty() ? "" : ": " + said.why();
  if (said.end() == idl::MACHINE_NOT_STARTED && works()) return lose(peer, "could not start" + why);
  decide(said.end(), title(peer) + " has ended the run" + why);
}

void Gathering::look(Moment now) {
  if (own_.phase() == idl::MACHINE_ENDED) return;
  for (Peer& peer : peers_) {
    if (!peer.said || peer.lost || peer.said->phase() == idl::MACHINE_ENDED) continue;
    if (now - peer.heard_at > peer.node.loss_limit)
      lose(peer, "was not heard for " + xml::number_text(to_seconds(peer.node.loss_limit)) + " s");
  }
}

void Gathering::lose(Peer& peer, const std::string& how) {
  peer.lost = true;
  const std::string text = title(peer) + " " + how;
  if (own_.phase() == idl::MACHINE_GATHERING) return tell(NewsKind::info, text);
  const bool ends = peer.node.on_loss == graph::OnLoss::stop;
  tell(NewsKind::lost, text + (ends ? ", so the run ends" : "; the others go on"), peer.node.name);
  if (ends) decide(works() ? idl::MACHINE_FAILED : idl::MACHINE_NOT_STARTED, text);
}

void Gathering::decide(idl::MachineEnd end, const std::string& why) {
  if (!verdict_ && own_.phase() != idl::MACHINE_ENDED) verdict_ = Verdict{end, why};
}

std::string Gathering::title(const Peer& peer) const { return name_of(peer.node.name); }

bool Gathering::has_heard_us(const idl::MachineState& state) const {
  return std::ranges::any_of(state.heard(), [&](const idl::MachineRun& heard) {
    return heard.machine() == here_ && heard.run() == own_.run();
  });
}

bool Gathering::is_there(const Peer& peer) const {
  return peer.said && !peer.lost && peer.said->phase() != idl::MACHINE_ENDED && has_heard_us(*peer.said);
}

idl::MachineState Gathering::state() const {
  idl::MachineState state = own_;
  const auto add = [&](const Peer& peer, std::uint64_t run) {
    idl::MachineRun heard;
    heard.machine(peer.node.name);
    heard.run(run);
    state.heard().push_back(heard);
  };
  for (const Peer& peer : peers_) {
    if (peer.refused) add(peer, *peer.refused);
    if (peer.said && !peer.lost) add(peer, peer.said->run());
  }
  return state;
}

std::vector<std::string> Gathering::missing() const {
  std::vector<std::string> names;
  for (const Peer& peer : peers_)
    if (!is_there(peer)) names.push_back(peer.node.name);
  return names;
}

std::vector<Gathering::Standing> Gathering::standings() const {
  std::vector<Standing> all;
  for (const Peer& peer : peers_) {
    all.push_back({.machine = peer.node.name, .phase = {}, .lost = peer.lost, .heard_at = peer.heard_at});
    if (peer.said) all.back().phase = peer.said->phase();
  }
  return all;
}

bool Gathering::have_all_reached(idl::MachinePhase phase) const {
  return std::ranges::all_of(peers_,
                             [&](const Peer& peer) { return peer.said && peer.said->phase() >= phase; });
}

bool Gathering::may_configure(const std::string& component) {
  enter(idl::MACHINE_CONFIGURING);
  auto& before = before_.at(component);
  own_.configured(before[here_]);
  return have_all_reached(idl::MACHINE_CONFIGURING) && std::ranges::all_of(peers_, [&](const Peer& peer) {
           return peer.said->configured() >= before[peer.node.name];
         });
}

bool Gathering::may_begin() {
  enter(idl::MACHINE_READY);
  own_.configured(components_);
  return have_all_reached(idl::MACHINE_READY);
}

bool Gathering::are_all_done() const {
  return own_.done() &&
         std::ranges::all_of(peers_, [](const Peer& peer) { return peer.said && peer.said->done(); });
}

bool Gathering::have_all_ended() const {
  return std::ranges::none_of(
      peers_, [&](const Peer& peer) { return is_there(peer) || (peer.refused && !peer.knows_refusal); });
}

std::vector<Gathering::News> Gathering::take_news() { return std::exchange(news_, {}); }

}  // namespace orca::supervisor
