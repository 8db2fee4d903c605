// SPDX-License-Identifier: LGPL-3.0-or-later
#include "applying/applying.hpp"

#include <utility>

#include "applying/graph_edit.hpp"
#include "applying/work.hpp"
#include "orca/base/log.hpp"
#include "orca/base/text.hpp"
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

}  // namespace

Applying::Applying(const graph::Graph& graph, const std::vector<Member*>& all, Operating& operating,
                   Exchanging& exchanging, Levers levers)
    : graph_(graph), all_(all), operating_(operating), exchanging_(exchanging), levers_(std::move(levers)) {}

Applying::~Applying() = default;

void Applying::answer(const ReplyPtr& reply, const Result<Outcome>& outcome) {
  if (!outcome) return reply->refuse(outcome.error());
  for (const graph::GraphPlan::Line& line : outcome->plan.lines) reply->add(record_of(line));
  for (const Record& record : outcome->processes) reply->add(record);
  if (outcome->plan.lines.empty() && !reply->as_json()) reply->add("the system runs like that already\n");
}

void Applying::compare(const std::string& file, const ReplyPtr& reply) {
  begin({file}, Way::compares, [reply](const Result<Outcome>& outcome) { answer(reply, outcome); });
}

void Applying::apply(const std::string& file, bool untried, const ReplyPtr& reply) {
  begin({file}, untried ? Way::carries_out_untried : Way::carries_out,
        [reply, file](const Result<Outcome>& outcome) {
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
  begin({"the changed graph", std::move(text).value()}, Way::carries_out,
        [reply](const Result<Outcome>& outcome) {
          answer(reply, outcome);
          if (!outcome) return;
          for (const graph::GraphPlan::Line& line : outcome->plan.lines)
            log::info(kLogName, "an operator has changed the system: " + line.part);
        });
}

void Applying::lose(const std::string& process) {
  if (work_) work_->lose(process);
}

void Applying::accept(const CheckedSystem& system, std::string text) {
  applied_ = std::move(text);
  levers_.accept(system);
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
  begin({*std::exchange(saved_, {})}, Way::carries_out, [](const Result<Outcome>& outcome) {
    if (!outcome)
      return log::error(kLogName, "the graph that was saved is not carried out, and all goes on as before: " +
                                      outcome.error().text());
    for (const graph::GraphPlan::Line& line : outcome->plan.lines)
      log::info(kLogName, "saved: " + line.part + ", " + line.change.field + ": " + line.change.before +
                              " -> " + line.change.after);
  });
}

Status Applying::can_change() const {
  if (work_)
    return fail(Code::unavailable, "another graph is being compared or applied; try again when that is done");
  if (!levers_.read) return fail(Code::unimplemented, "this supervisor reads no graphs");
  if (graph_.machines.size() < 2) return ok();
  std::vector<std::string> machines;
  for (const graph::MachineNode& node : graph_.machines) machines.push_back(node.name);
  return fail(Code::unimplemented,
              "a system on several machines (" + listed(machines) +
                  ") takes no other graph while it runs; stop it, and start it with that one");
}

void Applying::begin(GraphSource source, Way way, Told told) {
  if (const Status free = can_change(); !free.ok()) return told(free.error());
  work_ = std::make_shared<Work>(*this, std::move(source), way, std::move(told));
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
