// SPDX-License-Identifier: LGPL-3.0-or-later
#include "applying/applying.hpp"

#include <map>
#include <memory>
#include <set>
#include <utility>
#include <vector>

#include "applying/component_steps.hpp"
#include "applying/edge_steps.hpp"
#include "applying/graph_edit.hpp"
#include "applying/system_reading.hpp"
#include "orca/base/log.hpp"
#include "orca/graph/print.hpp"
#include "orca/supervisor/log_name.hpp"

namespace orca::supervisor {
namespace {

Record record_of(const graph::GraphPlan::Line& line) {
  return Record{{"part", line.part},
                {"field", line.change.field},
                {"before", line.change.before},
                {"after", line.change.after},
                {"effect", graph::to_string(line.effort)}};
}

void answer(const ReplyPtr& reply, const Result<graph::GraphPlan>& outcome) {
  if (!outcome) return reply->refuse(outcome.error());
  for (const graph::GraphPlan::Line& line : outcome->lines) reply->add(record_of(line));
  if (outcome->lines.empty() && !reply->as_json()) reply->add("the system runs like that already\n");
}

}  // namespace

// One graph file, from its reading to its end.
class Applying::Work : public std::enable_shared_from_this<Work> {
 public:
  Work(Applying& owner, GraphSource source, bool carries_out, Told told)
      : owner_(owner),
        carries_out_(carries_out),
        is_edit_(source.text.has_value()),
        told_(std::move(told)),
        reading_(std::in_place, owner.levers_.read, std::move(source), owner.levers_.wake) {}

  void go_on() {
    if (!reading_ || !reading_->is_done()) return;
    Result<CheckedSystem> read = std::move(reading_->outcome());
    reading_.reset();
    if (!read) return end(read.error());
    wanted_ = std::move(read).value();
    plan_ =
        graph::plan_of(is_edit_ ? owner_.graph_ : owner_.present(), wanted_.graph, wanted_.facts.contracts);
    lost_.clear();  // nothing was changed before
    if (!carries_out_) return end(std::nullopt);
    if (!plan_.is_possible()) return end(fail(Code::failed_precondition, graph::obstacles_of(plan_)));
    exchange_next();
  }
  void lose(const std::string& process) { lost_.insert(process); }
  [[nodiscard]] bool has_ended() const { return has_ended_; }

 private:
  // What a component ran before.
  struct Before {
    std::string component;
    CodeFacts code;
    graph::Params params;
  };

  [[nodiscard]] const graph::ComponentNode& node_of(const std::string& component) const {
    const graph::ComponentNode* const present = owner_.graph_.find_component(component);
    return present != nullptr ? *present : *wanted_.graph.find_component(component);
  }

  // Returns whether a component's process has ended or was started meanwhile, so that it begins as before.
  [[nodiscard]] bool is_lost(const std::string& component) const {
    return lost_.contains(node_of(component).process);
  }

  [[nodiscard]] Error loss() const {
    return fail(Code::unavailable,
                "process " + *lost_.begin() + " ended or was started meanwhile, so all goes back; try again");
  }

  void exchange_next() {
    if (!lost_.empty()) return go_back(loss());
    if (before_.size() == plan_.exchanges.size()) return set_all();
    const graph::GraphPlan::Exchange& next = plan_.exchanges[before_.size()];
    const graph::ComponentNode& node = node_of(next.component);
    before_.push_back({next.component, owner_.exchanging_.code_of(node), owner_.operating_.params_of(node)});
    const CodeFacts& present = before_.back().code;
    const std::string& file =
        present.type == next.type ? present.plugin.file : wanted_.facts.plugins[next.type].file;
    owner_.exchanging_.exchange({next.component, file, next.type, graph::print_values(next.params)},
                                [work = weak_from_this()](const Result<Record>& outcome) {
                                  if (const auto self = work.lock()) self->exchanged(outcome);
                                });
  }

  void exchanged(const Result<Record>& outcome) {
    if (outcome) return exchange_next();
    before_.pop_back();  // it runs what it ran before
    go_back(outcome.error());
  }

  void set_all() {
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

  void set_back(const Error& reason) {
    std::erase_if(settings_before_, [this](const auto& one) { return is_lost(one.first); });
    owner_.operating_.change(settings_before_, [work = weak_from_this(), reason](const Status& outcome) {
      if (const auto self = work.lock())
        self->go_back(outcome.ok() ? reason : with(reason, "parameters", outcome.error()));
    });
  }

  // Constructs new components beside those that are there, and those that will go.
  void come() {
    if (plan_.added.empty() && plan_.removed.empty()) return rewire();
    owner_.operating_.expect(comers());
    for (const std::string& name : plan_.removed)
      if (owner_.exchanging_.is_busy(name) || owner_.exchanging_.is_busy(node_of(name).hardware))
        return set_back(
            fail(Code::unavailable, "its code, or its driver, is being exchanged; try again later", name));
    const Result<std::vector<AddComponent>> orders = introduced();
    if (!orders) return set_back(orders.error());
    carry_out(arrival_steps(*orders), [this](const Status& outcome) {
      if (!outcome.ok()) return leave(outcome.error());
      lost_.empty() ? settle() : leave(loss());
    });
  }

  // Returns the processes of the components that come and go.
  [[nodiscard]] std::map<std::string, std::string> comers() const {
    std::map<std::string, std::string> comers;
    for (const graph::ComponentNode& node : plan_.added) comers[node.name] = node.process;
    for (const std::string& name : plan_.removed) comers[name] = node_of(name).process;
    return comers;
  }

  [[nodiscard]] Result<std::vector<AddComponent>> introduced() const {
    std::vector<AddComponent> orders;
    for (const graph::ComponentNode& node : plan_.added) {
      Result<AddComponent> order = owner_.levers_.introduce(node);
      if (!order) return order.error();
      orders.push_back(std::move(order).value());
    }
    if (const Status told = announce(orders, owner_.all_); !told.ok()) return told.error();
    return orders;
  }

  // Lets the new components go again.
  void leave(const Error& reason) {
    std::vector<std::string> names;
    for (const graph::ComponentNode& node : plan_.added) names.push_back(node.name);
    let_go(std::move(names), [this, reason] { set_back(reason); });
  }

  // Ends components, the last first, and goes on when that is done.
  void let_go(std::vector<std::string> names, std::function<void()> done) {
    if (names.empty()) return done();
    const std::string name = names.back();
    names.pop_back();
    announce_end(name, owner_.operating_.process_of(name), owner_.all_);
    const auto gone = [work = weak_from_this(), name, names, done](const Status& outcome) {
      const auto self = work.lock();
      if (!self) return;
      if (!outcome.ok() && outcome.error().code != Code::unavailable)
        log::warning(
            name, "it could not be removed: " + outcome.error().message + "; it goes when its process ends");
      self->let_go(names, done);
    };
    const Status sent = owner_.operating_.send(name, RemoveComponent{name}, gone);
    if (!sent.ok()) gone(sent);  // its process has ended
  }

  // Connects the new components with what they use, then configures them: they find their connections, as at a start.
  void settle() {
    change(plan_.connections_of(true), [this](const Status& outcome) {
      if (!outcome.ok()) return leave(renewed(outcome.error()));
      configure(0);
    });
  }

  void configure(std::size_t next) {
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

  // Lets the others change their connections, to the new components as well.
  void rewire() {
    change(plan_.connections_of(false), [this](const Status& outcome) {
      if (!outcome.ok()) return part(outcome.error());
      lost_.empty() ? commit() : undo(plan_.connections_of(false), loss(), &Work::part);
    });
  }

  // From here on the run has the new graph. Nobody is connected to what it does not have any more.
  void commit() {
    for (const graph::ComponentNode& node : plan_.added)
      (void)owner_.operating_.send(node.name, OpenGate{node.name}, [](const Status&) {});
    owner_.accept(wanted_);
    if (!is_edit_) owner_.operating_.forget_changes();
    for (const std::string& name : plan_.removed) owner_.exchanging_.forget(name);
    std::vector<std::string> names(plan_.removed.rbegin(), plan_.removed.rend());
    let_go(std::move(names), [this] { end(std::nullopt); });
  }

  // Removes the connections of the new components again.
  void part(const Error& reason) { undo(plan_.connections_of(true), reason, &Work::leave); }

  void undo(const std::vector<graph::GraphPlan::Rewiring>& connections, const Error& reason,
            void (Work::*then)(const Error&)) {
    change(graph::reversed(connections), [this, reason, then](const Status& outcome) {
      (this->*then)(renewed(outcome.ok() ? reason : with(reason, "connections", outcome.error())));
    });
  }

  // Gives edges of before new memory at both ends if these may not have the same: a process that comes back has made its ends
  // as before with memory of its own, perhaps before the other ends went back; and a client may have left an edge and come
  // back to it, while the server never left it.
  Error renewed(const Error& reason) {
    std::set<std::string> edges = std::exchange(*left_, {});
    for (const graph::GraphPlan::Rewiring& one : plan_.connections)
      if (one.before && !lost_.empty()) edges.insert(one.before->name());
    const Status renewed = owner_.levers_.renew(edges);
    return renewed.ok() ? reason : with(reason, "connections", renewed.error());
  }

  void change(const std::vector<graph::GraphPlan::Rewiring>& connections,
              std::function<void(const Status&)> done) {
    graph::Graph both = owner_.graph_;
    both.components.insert(both.components.end(), plan_.added.begin(), plan_.added.end());
    Result<std::vector<JointStep>> steps = edge_steps(both, connections, lost_, left_);
    if (!steps) return done(steps.error());
    carry_out(std::move(steps).value(), std::move(done));
  }

  void carry_out(std::vector<JointStep> steps, std::function<void(const Status&)> done) {
    owner_.operating_.carry_out(std::move(steps),
                                [work = weak_from_this(), done = std::move(done)](const Status& outcome) {
                                  if (const auto self = work.lock()) done(outcome);
                                });
  }

  static Error with(const Error& reason, const std::string& what, const Error& obstacle) {
    return fail(reason.code, reason.text() + "; and " + what + " could not go back: " + obstacle.text());
  }

  // Exchanges back what was exchanged, the last first.
  void go_back(const Error& reason) {
    if (before_.empty()) return end(reason);
    const Before before = std::move(before_.back());
    before_.pop_back();
    if (is_lost(before.component)) return go_back(reason);
    SwapWish wish{before.component, before.code.plugin.file, before.code.type,
                  graph::print_values(before.params)};
    wish.has_worked = true;
    const auto gone_back = [work = weak_from_this(), reason,
                            name = before.component](const Result<Record>& outcome) {
      if (const auto self = work.lock())
        self->go_back(outcome ? reason : with(reason, name, outcome.error()));
    };
    owner_.exchanging_.exchange(std::move(wish), gone_back);
  }

  void end(const std::optional<Error>& error) {
    has_ended_ = true;
    owner_.operating_.expect({});
    if (error) return told_(*error);
    told_(plan_);
  }

  Applying& owner_;
  const bool carries_out_;
  const bool is_edit_;  // of the run's graph: what operators have set and exchanged stays as it is
  const Told told_;
  CheckedSystem wanted_;
  graph::GraphPlan plan_;
  std::vector<Before> before_;                            // of each exchange that was begun
  std::map<std::string, graph::Params> settings_before_;  // by component
  std::set<std::string> lost_;                            // processes that have ended since the reading
  // edges that clients have left, see edge_steps()
  const std::shared_ptr<std::set<std::string>> left_ = std::make_shared<std::set<std::string>>();
  bool has_ended_ = false;
  std::optional<SystemReading> reading_;
};

Applying::Applying(const graph::Graph& graph, const std::vector<Member*>& all, Operating& operating,
                   Exchanging& exchanging, Levers levers)
    : graph_(graph), all_(all), operating_(operating), exchanging_(exchanging), levers_(std::move(levers)) {}

Applying::~Applying() = default;

void Applying::compare(const std::string& file, const ReplyPtr& reply) {
  begin({file}, false, [reply](const Result<graph::GraphPlan>& outcome) { answer(reply, outcome); });
}

void Applying::apply(const std::string& file, const ReplyPtr& reply) {
  begin({file}, true, [reply, file](const Result<graph::GraphPlan>& outcome) {
    answer(reply, outcome);
    if (outcome) log::info(kLogName, "an operator has applied " + file);
  });
}

void Applying::connect(const std::vector<std::string>& words, const ReplyPtr& reply) {
  edit(with_connection(graph_, words), reply);
}

void Applying::disconnect(const std::vector<std::string>& words, const ReplyPtr& reply) {
  edit(without_connection(graph_, words.at(0), words.at(1)), reply);
}

void Applying::move(const std::vector<std::string>& words, const ReplyPtr& reply) {
  edit(with_other_server(graph_, words.at(0), words.at(1)), reply);
}

void Applying::edit(Result<std::string> text, const ReplyPtr& reply) {
  if (!text) return reply->refuse(text.error());
  begin({"the changed graph", std::move(text).value()}, true,
        [reply](const Result<graph::GraphPlan>& outcome) {
          answer(reply, outcome);
          if (!outcome) return;
          for (const graph::GraphPlan::Line& line : outcome->lines)
            log::info(kLogName, "an operator has changed the system: " + line.part);
        });
}

void Applying::lose(const std::string& process) {
  if (work_) work_->lose(process);
}

void Applying::accept(const CheckedSystem& wanted) {
  applied_ = graph::print(wanted.graph);
  levers_.accept(wanted);
  came_up(all_);
}

// The order of the file counts for who adopts them, and is not that of the graph that was changed in place.
void Applying::came_up(const std::vector<Member*>& members) const {
  if (!applied_) return;
  for (Member* const member : members)
    if (member->is_built()) member->tell(NoteGraph{*applied_});  // others are told when they have come up
}

void Applying::go_on() {
  if (work_) work_->go_on();
  if (work_ && work_->has_ended()) work_.reset();
  if (work_ || !saved_) return;
  begin({*std::exchange(saved_, {})}, true, [](const Result<graph::GraphPlan>& outcome) {
    if (!outcome)
      return log::error(kLogName, "the graph that was saved is not carried out, and all goes on as before: " +
                                      outcome.error().text());
    for (const graph::GraphPlan::Line& line : outcome->lines)
      log::info(kLogName, "saved: " + line.part + ", " + line.change.field + ": " + line.change.before +
                              " -> " + line.change.after);
  });
}

void Applying::begin(GraphSource source, bool carries_out, Told told) {
  if (work_)
    return told(
        fail(Code::unavailable, "another graph is being compared or applied; try again when that is done"));
  if (!levers_.read) return told(fail(Code::unimplemented, "this supervisor reads no graphs"));
  if (graph_.machines.size() > 1)
    return told(fail(Code::unimplemented, "a system on several machines takes no other graph while it runs"));
  work_ = std::make_shared<Work>(*this, std::move(source), carries_out, std::move(told));
}

// Returns the graph as it would be written for what runs now.
graph::Graph Applying::present() const {
  graph::Graph present = graph_;
  for (graph::ComponentNode& node : present.components) {
    node.params = operating_.params_of(node);
    node.type = exchanging_.code_of(node).type;
  }
  return present;
}

}  // namespace orca::supervisor
