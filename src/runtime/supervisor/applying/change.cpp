// SPDX-License-Identifier: LGPL-3.0-or-later
#include "applying/change.hpp"

#include <algorithm>
#include <optional>
#include <ranges>
#include <utility>

#include "applying/edge_steps.hpp"
#include "orca/base/log.hpp"
#include "orca/base/text.hpp"
#include "orca/graph/placement.hpp"
#include "orca/graph/print.hpp"

namespace orca::supervisor {
namespace {

Error with(const Error& reason, const std::string& what, const Error& obstacle) {
  return fail(reason.code, reason.text() + "; and " + what + " could not go back: " + obstacle.text());
}

std::string effect_on(const Member* member, bool stays) {
  if (member == nullptr) return "begins";
  if (!stays) return "ends";
  const std::optional<Duration>& time = member->starts().time;
  return "is started again" +
         (time ? ", which took " + seconds_text(*time) + " the last time" : std::string());
}

// Tells of each process that begins, ends or begins anew what becomes of it, for people.
std::vector<Record> records_of(const std::set<std::string>& renewed, const Members& all,
                               const graph::Graph& wanted) {
  const std::vector<graph::ProcessNode> after = graph::processes_of(wanted);
  std::vector<Record> records;
  for (const std::string& name : renewed) {
    const auto member = std::ranges::find(all, name, &Member::name);
    const bool stays = std::ranges::find(after, name, &graph::ProcessNode::name) != after.end();
    records.push_back({{"part", "= process " + name},
                       {"field", ""},
                       {"before", ""},
                       {"after", ""},
                       {"effect", effect_on(member == all.end() ? nullptr : *member, stays)}});
  }
  return records;
}

// Returns the steps that construct components in their processes, unconnected.
std::vector<JointStep> arrival_steps(const std::vector<AddComponent>& components) {
  std::vector<JointStep> steps;
  for (const AddComponent& component : components) {
    const auto make = [component]() -> std::optional<ThereAndBack> {
      return ThereAndBack{component, RemoveComponent{component.node.name}};
    };
    steps.push_back({component.node.name, make, [](bool) {}});
  }
  return steps;
}

}  // namespace

Applying::Change::Change(Applying& owner, Way way, const Care& care, bool is_edit)
    : owner_(owner),
      place_(owner.place_),
      way_(way),
      care_(care),
      is_edit_(is_edit),
      announcing_(owner.place_.graph, owner.place_.all, owner.place_.starter, owner.place_.ledger) {
  owner.change_ = this;
}

Applying::Change::~Change() {
  owner_.change_ = nullptr;
  place_.operating.expect({});
}

Result<Applying::Outcome> Applying::Change::carry_out(const GraphSource& source) {
  if (Status done = read(source); !done.ok()) return done.error();
  const Outcome outcome{plan_, records_of(plan_.renewed, place_.all, wanted_.graph)};
  if (way_ == Way::compares) return outcome;
  if (Status possible = is_possible(); !possible.ok()) return possible.error();
  for (Status (Change::*const step)() : {&Change::exchange, &Change::set, &Change::come, &Change::settle,
                                         &Change::rewire, &Change::set_late, &Change::exchange_late}) {
    Status done = (this->*step)();
    if (done.ok() && !lost_.empty()) done = loss();
    if (!done.ok()) return go_back(done.error());
  }
  if (Status done = renew(); !done.ok()) return go_back(done.error());
  commit();
  return outcome;
}

Error Applying::Change::go_back(Error reason) {
  for (; !undo_.empty(); undo_.pop_back()) reason = undo_.back()(reason);
  return reason;
}

Status Applying::Change::read(const GraphSource& source) {
  // It loads plugins, and takes its time.
  Result<CheckedSystem> read = fail(Code::internal, "the graph was not read");
  place_.conductor.run_aside("reading", [&](const auto&) { read = owner_.levers_.read(source); });
  if (!read) return read.error();
  wanted_ = std::move(read).value();
  plan_ = graph::plan_of(is_edit_ ? place_.graph : owner_.present(), wanted_.graph, wanted_.facts.contracts,
                         {true, owner_.levers_.executor});
  lost_.clear();  // nothing was changed before
  return ok();
}

Status Applying::Change::is_possible() const {
  if (!plan_.is_possible()) return fail(Code::failed_precondition, graph::obstacles_of(plan_));
  if (is_edit_ && !plan_.renewed.empty())
    return fail(Code::failed_precondition,
                "process " + *plan_.renewed.begin() +
                    " has to be started again for that; change the graph's file and use orcactl apply");
  return can_renew();
}

void Applying::Change::lose(const std::string& process) {
  if (!is_renewing_ || !plan_.renewed.contains(process)) lost_.insert(process);
}

const graph::ComponentNode& Applying::Change::node_of(const std::string& component) const {
  const graph::ComponentNode* const present = place_.graph.find_component(component);
  return present != nullptr ? *present : *wanted_.graph.find_component(component);
}

bool Applying::Change::is_lost(const std::string& component) const {
  return lost_.contains(node_of(component).process);
}

Error Applying::Change::loss() const {
  return fail(Code::unavailable,
              "process " + *lost_.begin() + " ended or was started meanwhile, so all goes back; try again");
}

// ---- Code and parameters

// Values may name what is connected only later, as the behaviours that a fuser requires. So what is refused is tried again with the new
// connections.
Status Applying::Change::exchange() {
  for (const graph::GraphPlan::Exchange& wanted : plan_.exchanges) {
    if (!lost_.empty()) return loss();
    set_after_ = undo_.size();
    Status done = exchange(wanted, nullptr);
    if (done.ok()) continue;
    if (!lost_.empty() || !changes_connections_of(wanted.component)) return done;
    late_exchanges_.push_back(&wanted);
  }
  return ok();
}

Status Applying::Change::exchange_late() {
  for (const graph::GraphPlan::Exchange* const wanted : late_exchanges_) {
    if (!lost_.empty()) return loss();
    if (Status done = exchange(*wanted, &wanted_.graph); !done.ok()) return done;
  }
  return ok();
}

bool Applying::Change::changes_connections_of(const std::string& component) const {
  return std::ranges::any_of(plan_.connections, [&](const graph::GraphPlan::Rewiring& one) {
    const graph::Edge& edge = one.after ? *one.after : *one.before;
    return edge.from.component == component || edge.to.component == component;
  });
}

Status Applying::Change::exchange(const graph::GraphPlan::Exchange& wanted, const graph::Graph* changed) {
  const graph::ComponentNode& node = node_of(wanted.component);
  const CodeFacts present = place_.exchanging.code_of(node);
  SwapWish before{wanted.component, present.plugin.file, present.type,
                  graph::print_values(place_.operating.params_of(node)), care_};
  before.has_worked = true;
  SwapWish wish{wanted.component,
                present.type == wanted.type ? present.plugin.file : wanted_.facts.plugins[wanted.type].file,
                wanted.type, graph::print_values(wanted.params), care_};
  wish.changed = changed;
  if (const Result<Record> done = place_.exchanging.exchange(wish); !done) return done.error();
  add_early_undo([this, before](const Error& reason) { return exchange_back(before, reason); });
  return ok();
}

// The values of before fit the connections of before: they go back after these, whenever they were set.
void Applying::Change::add_early_undo(Undo undo) {
  undo_.insert(undo_.begin() + static_cast<std::ptrdiff_t>(set_after_), std::move(undo));
}

Error Applying::Change::exchange_back(const SwapWish& before, const Error& reason) {
  if (is_lost(before.component)) return reason;
  const Result<Record> done = place_.exchanging.exchange(before);
  return done ? reason : with(reason, before.component, done.error());
}

// As exchange(); who refuses may have asked another component about its connections.
Status Applying::Change::set() {
  set_after_ = undo_.size();
  Status done = set_all();
  sets_late_ = !done.ok() && lost_.empty() && !plan_.connections.empty();
  return sets_late_ ? ok() : done;
}

Status Applying::Change::set_late() { return sets_late_ ? set_all() : ok(); }

Status Applying::Change::set_all() {
  std::map<std::string, graph::Params> before;
  for (const auto& [component, values] : plan_.settings) {
    const graph::Params present = place_.operating.params_of(node_of(component));
    for (const auto& [param, value] : values) before[component][param] = present.at(param);
  }
  if (Status done = place_.operating.change(plan_.settings); !done.ok()) return done;
  add_early_undo([this, before](const Error& reason) mutable {
    std::erase_if(before, [this](const auto& one) { return is_lost(one.first); });
    const Status done = place_.operating.change(before);
    return done.ok() ? reason : with(reason, "parameters", done.error());
  });
  return ok();
}

// ---- Components that come and go

// Constructs new components beside those that are there, and those that will go.
Status Applying::Change::come() {
  if (plan_.added.empty() && plan_.removed.empty() && plan_.renewed.empty()) return ok();
  place_.operating.expect(comers());
  for (const std::string& name : plan_.removed)
    if (place_.exchanging.is_busy(name) || place_.exchanging.is_busy(node_of(name).hardware))
      return fail(Code::unavailable, "its code, or its driver, is being exchanged; try again later", name);
  const Result<std::vector<AddComponent>> orders = announcing_.begin(plan_, wanted_.graph);
  if (!orders) return orders.error();
  undo_.emplace_back([this](const Error& reason) {
    announcing_.take_back();
    for (const graph::ComponentNode& node : std::views::reverse(plan_.added)) let_go(node.name);
    return reason;
  });
  return place_.operating.carry_out(arrival_steps(*orders));
}

std::map<std::string, std::string> Applying::Change::comers() const {
  std::map<std::string, std::string> comers;
  for (const graph::ComponentNode& node : plan_.added) comers[node.name] = node.process;
  for (const std::string& name : plan_.removed) comers[name] = node_of(name).process;
  return comers;
}

void Applying::Change::let_go(const std::string& name) {
  announce_end(name, place_.operating.process_of(name), place_.all);
  const Status gone = place_.operating.send(name, RemoveComponent{name});
  if (!gone.ok() && gone.error().code != Code::unavailable)  // that is: its process has ended
    log::warning(name,
                 "it could not be removed: " + gone.error().message + "; it goes when its process ends");
}

// ---- Connections

// Connects the new components with what they use, then configures them: they find their connections, as at a start.
Status Applying::Change::settle() {
  const Connections connections = plan_.connections_of(true);
  if (const Status done = change(connections); !done.ok()) return renewed(done.error());
  undo_.emplace_back([this, connections](const Error& reason) { return change_back(connections, reason); });
  for (const graph::ComponentNode& node : plan_.added) {
    if (!lost_.empty()) return loss();
    if (Status done = place_.operating.send(node.name, Configure{node.name}); !done.ok()) return done;
  }
  return ok();
}

// Lets the others change their connections, to the new components as well.
Status Applying::Change::rewire() {
  const Connections connections = plan_.connections_of(false);
  if (Status done = change(connections); !done.ok()) return done;
  undo_.emplace_back([this, connections](const Error& reason) { return change_back(connections, reason); });
  return ok();
}

Status Applying::Change::change(const Connections& connections) {
  graph::Graph both = place_.graph;
  for (const graph::ComponentNode& node : wanted_.graph.components)
    if (both.find_component(node.name) == nullptr) both.components.push_back(node);
  std::set<std::string> others = lost_;
  others.insert(plan_.renewed.begin(), plan_.renewed.end());
  Result<std::vector<JointStep>> steps = edge_steps(both, connections, others, left_);
  if (!steps) return steps.error();
  // Nobody waits for what is sent or asked on a new connection until the process at its other end has begun anew.
  for (JointStep& step : *steps)
    step.obeyed = [this, component = step.component, then = step.obeyed](bool has_gone) {
      then(has_gone);
      if (has_gone && !is_renewing_) cut_off(component, plan_, wanted_.graph, place_.all);
    };
  return place_.operating.carry_out(*steps);
}

Error Applying::Change::change_back(const Connections& connections, const Error& reason) {
  const Status done = change(graph::reversed(connections));
  return renewed(done.ok() ? reason : with(reason, "connections", done.error()));
}

Error Applying::Change::renewed(const Error& reason) {
  std::set<std::string> edges = std::exchange(left_, {});
  for (const graph::GraphPlan::Rewiring& one : plan_.connections)
    if (one.before && !lost_.empty()) edges.insert(one.before->name());
  const Status renewed = place_.starter.renew_edges(edges);
  return renewed.ok() ? reason : with(reason, "connections", renewed.error());
}

// ---- Processes that begin, end or begin anew

// A component would not be suspended any more, and the robot perhaps move.
Status Applying::Change::can_renew() const {
  if (plan_.renewed.empty()) return ok();
  for (const graph::ComponentNode& node : place_.graph.components)
    if (plan_.renewed.contains(node.process) && place_.operating.is_suspended(node.name))
      return fail(Code::failed_precondition,
                  "it is suspended, and its process has to begin anew; resume it before", node.name);
  return owner_.levers_.can_renew();
}

// All else is as wanted. If the processes cannot begin with the new graph, they run as before.
Status Applying::Change::renew() {
  const auto go = [this] { owner_.accept(wanted_, graph::print(wanted_.graph)); };
  if (plan_.renewed.empty()) return go(), ok();
  if (Status ready = can_renew(); !ready.ok()) return ready;
  is_renewing_ = true;
  const auto go_back = [this, before = CheckedSystem{place_.graph, place_.facts, {}},
                        text = owner_.applied_.value_or(graph::print(place_.graph))] {
    owner_.accept(before, text);
  };
  Status done = place_.renewal.carry_out({plan_.renewed, go, go_back});
  if (!done.ok()) lost_.insert(plan_.renewed.begin(), plan_.renewed.end());
  return done;
}

// The run has the new graph. Nobody is connected to what it does not have any more.
void Applying::Change::commit() {
  for (const graph::ComponentNode& node : plan_.added) place_.operating.tell(node.name, OpenGate{node.name});
  if (!is_edit_) place_.operating.present().forget_changes();
  for (const std::string& name : plan_.removed) place_.exchanging.forget(name);
  for (const std::string& name : announcing_.tell_of_the_gone()) place_.exchanging.forget(name);
  for (const std::string& name : plan_.removed) let_go(name);
}

}  // namespace orca::supervisor
