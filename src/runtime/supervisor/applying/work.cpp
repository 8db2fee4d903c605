// SPDX-License-Identifier: LGPL-3.0-or-later
#include "applying/work.hpp"

#include <utility>

#include "applying/component_steps.hpp"
#include "applying/edge_steps.hpp"
#include "applying/newcomers.hpp"
#include "orca/base/log.hpp"
#include "orca/graph/print.hpp"

namespace orca::supervisor {
namespace {

Error with(const Error& reason, const std::string& what, const Error& obstacle) {
  return fail(reason.code, reason.text() + "; and " + what + " could not go back: " + obstacle.text());
}

}  // namespace

Applying::Work::Work(Applying& owner, GraphSource source, Way way, Told told)
    : owner_(owner),
      way_(way),
      is_edit_(source.text.has_value()),
      told_(std::move(told)),
      announcing_(owner.graph_, owner.all_, owner.levers_.introduce, owner.levers_.introduce_processes),
      reading_(std::in_place, owner.levers_.read, std::move(source), owner.levers_.wake) {}

void Applying::Work::go_on() {
  if (!reading_ || !reading_->is_done()) return;
  Result<CheckedSystem> read = std::move(reading_->outcome());
  reading_.reset();
  if (!read) return end(read.error());
  wanted_ = std::move(read).value();
  plan_ = graph::plan_of(is_edit_ ? owner_.graph_ : owner_.present(), wanted_.graph, wanted_.facts.contracts,
                         {true, owner_.levers_.executor});
  processes_ = records_of(plan_.renewed, owner_.all_, wanted_.graph);
  lost_.clear();  // nothing was changed before
  if (way_ == Way::compares) return end(std::nullopt);
  if (!plan_.is_possible()) return end(fail(Code::failed_precondition, graph::obstacles_of(plan_)));
  if (is_edit_ && !plan_.renewed.empty())
    return end(fail(Code::failed_precondition,
                    "process " + *plan_.renewed.begin() +
                        " has to be started again for that; change the graph's file and use orcactl apply"));
  if (const Status ready = can_renew(); !ready.ok()) return end(ready.error());
  exchange_next();
}

void Applying::Work::lose(const std::string& process) {
  if (!is_renewing_ || !plan_.renewed.contains(process)) lost_.insert(process);
}

const graph::ComponentNode& Applying::Work::node_of(const std::string& component) const {
  const graph::ComponentNode* const present = owner_.graph_.find_component(component);
  return present != nullptr ? *present : *wanted_.graph.find_component(component);
}

bool Applying::Work::is_lost(const std::string& component) const {
  return lost_.contains(node_of(component).process);
}

Error Applying::Work::loss() const {
  return fail(Code::unavailable,
              "process " + *lost_.begin() + " ended or was started meanwhile, so all goes back; try again");
}

void Applying::Work::exchange_next() {
  if (!lost_.empty()) return go_back(loss());
  if (before_.size() == plan_.exchanges.size()) return set_all();
  const graph::GraphPlan::Exchange& next = plan_.exchanges[before_.size()];
  const graph::ComponentNode& node = node_of(next.component);
  before_.push_back({next.component, owner_.exchanging_.code_of(node), owner_.operating_.params_of(node)});
  const CodeFacts& present = before_.back().code;
  const std::string& file =
      present.type == next.type ? present.plugin.file : wanted_.facts.plugins[next.type].file;
  SwapWish wish{next.component, file, next.type, graph::print_values(next.params)};
  wish.untried = way_ == Way::carries_out_untried;
  owner_.exchanging_.exchange(std::move(wish), [work = weak_from_this()](const Result<Record>& outcome) {
    if (const auto self = work.lock()) self->exchanged(outcome);
  });
}

void Applying::Work::exchanged(const Result<Record>& outcome) {
  if (outcome) return exchange_next();
  before_.pop_back();  // it runs what it ran before
  go_back(outcome.error());
}

void Applying::Work::set_all() {
  for (const auto& [component, values] : plan_.settings) {
    const graph::Params present = owner_.operating_.params_of(node_of(component));
    for (const auto& [param, value] : values) settings_before_[component][param] = present.at(param);
  }
  owner_.operating_.change(plan_.settings, [work = weak_from_this()](const Status& outcome) {
    const auto self = work.lock();
    if (!self) return;
    if (!outcome.ok()) return self->go_back(outcome.error());
    self->lost_.empty() ? self->come() : self->set_back(self->loss());
  });
}

void Applying::Work::set_back(const Error& reason) {
  std::erase_if(settings_before_, [this](const auto& one) { return is_lost(one.first); });
  owner_.operating_.change(settings_before_, [work = weak_from_this(), reason](const Status& outcome) {
    if (const auto self = work.lock())
      self->go_back(outcome.ok() ? reason : with(reason, "parameters", outcome.error()));
  });
}

void Applying::Work::come() {
  if (plan_.added.empty() && plan_.removed.empty() && plan_.renewed.empty()) return rewire();
  owner_.operating_.expect(comers());
  for (const std::string& name : plan_.removed)
    if (owner_.exchanging_.is_busy(name) || owner_.exchanging_.is_busy(node_of(name).hardware))
      return set_back(
          fail(Code::unavailable, "its code, or its driver, is being exchanged; try again later", name));
  const Result<std::vector<AddComponent>> orders = announcing_.begin(plan_, wanted_.graph);
  if (!orders) return set_back(orders.error());
  carry_out(arrival_steps(*orders), [this](const Status& outcome) {
    if (!outcome.ok()) return leave(outcome.error());
    lost_.empty() ? settle() : leave(loss());
  });
}

std::map<std::string, std::string> Applying::Work::comers() const {
  std::map<std::string, std::string> comers;
  for (const graph::ComponentNode& node : plan_.added) comers[node.name] = node.process;
  for (const std::string& name : plan_.removed) comers[name] = node_of(name).process;
  return comers;
}

void Applying::Work::leave(const Error& reason) {
  announcing_.take_back();
  std::vector<std::string> names;
  for (const graph::ComponentNode& node : plan_.added) names.push_back(node.name);
  let_go(std::move(names), [this, reason] { set_back(reason); });
}

void Applying::Work::let_go(std::vector<std::string> names, std::function<void()> done) {
  if (names.empty()) return done();
  const std::string name = names.back();
  names.pop_back();
  announce_end(name, owner_.operating_.process_of(name), owner_.all_);
  const auto gone = [work = weak_from_this(), name, names, done](const Status& outcome) {
    const auto self = work.lock();
    if (!self) return;
    if (!outcome.ok() && outcome.error().code != Code::unavailable)
      log::warning(name,
                   "it could not be removed: " + outcome.error().message + "; it goes when its process ends");
    self->let_go(names, done);
  };
  const Status sent = owner_.operating_.send(name, RemoveComponent{name}, gone);
  if (!sent.ok()) gone(sent);  // its process has ended
}

void Applying::Work::settle() {
  change(plan_.connections_of(true), [this](const Status& outcome) {
    if (!outcome.ok()) return leave(renewed(outcome.error()));
    configure(0);
  });
}

void Applying::Work::configure(std::size_t next) {
  if (!lost_.empty()) return part(loss());
  if (next == plan_.added.size()) return rewire();
  const std::string& name = plan_.added[next].name;
  const auto configured = [work = weak_from_this(), next](const Status& outcome) {
    const auto self = work.lock();
    if (!self) return;
    outcome.ok() ? self->configure(next + 1) : self->part(outcome.error());
  };
  const Status sent = owner_.operating_.send(name, Configure{name}, configured);
  if (!sent.ok()) part(sent.error());
}

void Applying::Work::rewire() {
  change(plan_.connections_of(false), [this](const Status& outcome) {
    if (!outcome.ok()) return part(outcome.error());
    if (!lost_.empty()) return undo(plan_.connections_of(false), loss(), &Work::part);
    if (!plan_.renewed.empty()) return renew();
    owner_.accept(wanted_, graph::print(wanted_.graph));
    commit();
  });
}

// A component would not be suspended any more, and the robot perhaps move.
Status Applying::Work::can_renew() const {
  if (plan_.renewed.empty()) return ok();
  for (const graph::ComponentNode& node : owner_.graph_.components)
    if (plan_.renewed.contains(node.process) && owner_.operating_.is_suspended(node.name))
      return fail(Code::failed_precondition,
                  "it is suspended, and its process has to begin anew; resume it before", node.name);
  return owner_.levers_.can_renew();
}

void Applying::Work::renew() {
  if (const Status ready = can_renew(); !ready.ok())
    return undo(plan_.connections_of(false), ready.error(), &Work::part);
  is_renewing_ = true;
  const auto go = [work = weak_from_this()] {
    if (const auto self = work.lock()) self->owner_.accept(self->wanted_, graph::print(self->wanted_.graph));
  };
  const auto go_back = [work = weak_from_this(), before = owner_.levers_.present(),
                        text = owner_.applied_.value_or(graph::print(owner_.graph_))] {
    if (const auto self = work.lock()) self->owner_.accept(before, text);
  };
  owner_.levers_.renew_processes({plan_.renewed, go, go_back},
                                 [work = weak_from_this()](const Status& outcome) {
                                   if (const auto self = work.lock())
                                     outcome.ok() ? self->commit() : self->run_as_before(outcome.error());
                                 });
}

void Applying::Work::run_as_before(const Error& reason) {
  lost_.insert(plan_.renewed.begin(), plan_.renewed.end());
  undo(plan_.connections_of(false), reason, &Work::part);
}

void Applying::Work::commit() {
  for (const graph::ComponentNode& node : plan_.added)
    (void)owner_.operating_.send(node.name, OpenGate{node.name}, [](const Status&) {});
  if (!is_edit_) owner_.operating_.forget_changes();
  for (const std::string& name : plan_.removed) owner_.exchanging_.forget(name);
  for (const std::string& name : announcing_.tell_of_the_gone()) owner_.exchanging_.forget(name);
  std::vector<std::string> names(plan_.removed.rbegin(), plan_.removed.rend());
  let_go(std::move(names), [this] { end(std::nullopt); });
}

void Applying::Work::part(const Error& reason) { undo(plan_.connections_of(true), reason, &Work::leave); }

void Applying::Work::undo(const std::vector<graph::GraphPlan::Rewiring>& connections, const Error& reason,
                          void (Work::*then)(const Error&)) {
  change(graph::reversed(connections), [this, reason, then](const Status& outcome) {
    (this->*then)(renewed(outcome.ok() ? reason : with(reason, "connections", outcome.error())));
  });
}

Error Applying::Work::renewed(const Error& reason) {
  std::set<std::string> edges = std::exchange(*left_, {});
  for (const graph::GraphPlan::Rewiring& one : plan_.connections)
    if (one.before && !lost_.empty()) edges.insert(one.before->name());
  const Status renewed = owner_.levers_.renew(edges);
  return renewed.ok() ? reason : with(reason, "connections", renewed.error());
}

void Applying::Work::change(const std::vector<graph::GraphPlan::Rewiring>& connections,
                            std::function<void(const Status&)> done) {
  graph::Graph both = owner_.graph_;
  for (const graph::ComponentNode& node : wanted_.graph.components)
    if (both.find_component(node.name) == nullptr) both.components.push_back(node);
  std::set<std::string> others = lost_;
  others.insert(plan_.renewed.begin(), plan_.renewed.end());
  Result<std::vector<JointStep>> steps = edge_steps(both, connections, others, left_);
  if (!steps) return done(steps.error());
  if (!is_renewing_)
    for (JointStep& step : *steps) cut_off_after(step);
  carry_out(std::move(steps).value(), std::move(done));
}

void Applying::Work::cut_off_after(JointStep& step) {
  step.obeyed = [work = weak_from_this(), component = step.component, then = step.obeyed](bool has_gone) {
    then(has_gone);
    if (const auto self = work.lock(); self && has_gone)
      supervisor::cut_off(component, self->plan_, self->wanted_.graph, self->owner_.all_);
  };
}

void Applying::Work::carry_out(std::vector<JointStep> steps, std::function<void(const Status&)> done) {
  owner_.operating_.carry_out(std::move(steps),
                              [work = weak_from_this(), done = std::move(done)](const Status& outcome) {
                                if (const auto self = work.lock()) done(outcome);
                              });
}

void Applying::Work::go_back(const Error& reason) {
  if (before_.empty()) return end(reason);
  const Before before = std::move(before_.back());
  before_.pop_back();
  if (is_lost(before.component)) return go_back(reason);
  SwapWish wish{before.component, before.code.plugin.file, before.code.type,
                graph::print_values(before.params)};
  wish.has_worked = true;
  const auto gone_back = [work = weak_from_this(), reason,
                          name = before.component](const Result<Record>& outcome) {
    if (const auto self = work.lock()) self->go_back(outcome ? reason : with(reason, name, outcome.error()));
  };
  owner_.exchanging_.exchange(std::move(wish), gone_back);
}

void Applying::Work::end(const std::optional<Error>& error) {
  has_ended_ = true;
  owner_.operating_.expect({});
  if (error) return told_(*error);
  told_(Outcome{plan_, processes_});
}

}  // namespace orca::supervisor
