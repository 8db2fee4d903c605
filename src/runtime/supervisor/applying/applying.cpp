// SPDX-License-Identifier: LGPL-3.0-or-later
#include "applying/applying.hpp"

#include <utility>

#include "applying/change.hpp"
#include "applying/graph_edit.hpp"
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

void Applying::answer(const ReplyPtr& reply, const Result<Outcome>& outcome) {
  if (!outcome) return reply->refuse(outcome.error());
  for (const graph::GraphPlan::Line& line : outcome->plan.lines) reply->add(record_of(line));
  for (const Record& record : outcome->processes) reply->add(record);
  if (outcome->plan.lines.empty() && !reply->as_json()) reply->add("the system runs like that already\n");
}

void Applying::compare(const std::string& file, const ReplyPtr& reply) {
  answer(reply, carry_out({file}, Way::compares));
}

void Applying::apply(const std::vector<std::string>& words, const ReplyPtr& reply) {
  const std::string file = words.empty() ? "" : words.front();
  const Result<Care> care = read_care(words);
  if (!care) return reply->refuse(care.error());
  const Result<Outcome> outcome = carry_out({file}, Way::carries_out, *care);
  answer(reply, outcome);
  if (outcome) log::info(kLogName, "an operator has applied " + file);
}

void Applying::show_present(Reply& reply) const {
  if (const Status one = has_one_machine(); !one.ok()) return reply.refuse(one.error());
  reply.add(reply.as_json() ? graph::graph_json(present()) : graph::print(present()));
}

void Applying::connect(const std::vector<std::string>& words, const ReplyPtr& reply) {
  edit(with_connection(place_.graph, words), reply);
}

void Applying::disconnect(const std::vector<std::string>& words, const ReplyPtr& reply) {
  edit(without_connection(place_.graph, words.at(0), words.at(1)), reply);
}

void Applying::move(const std::vector<std::string>& words, const ReplyPtr& reply) {
  edit(with_other_server(place_.graph, words.at(0), words.at(1)), reply);
}

void Applying::edit(const Result<std::string>& text, const ReplyPtr& reply) {
  if (!text) return reply->refuse(text.error());
  const Result<Outcome> outcome = carry_out({"the changed graph", *text}, Way::carries_out);
  answer(reply, outcome);
  if (!outcome) return;
  for (const graph::GraphPlan::Line& line : outcome->plan.lines)
    log::info(kLogName, "an operator has changed the system: " + line.part);
}

void Applying::lose(const std::string& process) {
  if (change_ != nullptr) change_->lose(process);
}

void Applying::accept(const CheckedSystem& system, std::string text) {
  applied_ = std::move(text);
  levers_.accept(system);
  came_up(place_.all);
}

// The order of the file counts for who adopts them, and is not that of the graph that was changed in place.
void Applying::came_up(const std::vector<Member*>& members) const {
  if (!applied_) return;
  for (Member* const member : members)
    if (member->is_built()) member->tell(NoteGraph{*applied_});  // others are told when they have come up
}

void Applying::go_on() {
  if (change_ != nullptr || !saved_) return;
  place_.conductor.begin("apply", [this, file = *std::exchange(saved_, {})] { carry_out_saved(file); });
}

void Applying::carry_out_saved(const std::string& file) {
  const Result<Outcome> outcome = carry_out({file}, Way::carries_out);
  if (!outcome)
    return log::error(kLogName, "the graph that was saved is not carried out, and all goes on as before: " +
                                    outcome.error().text());
  for (const graph::GraphPlan::Line& line : outcome->plan.lines)
    log::info(kLogName, "saved: " + line.part + ", " + line.change.field + ": " + line.change.before +
                            " -> " + line.change.after);
}

Status Applying::can_change() const {
  if (change_ != nullptr)
    return fail(Code::unavailable, "another graph is being compared or applied; try again when that is done");
  if (!levers_.read)
    return fail(Code::unimplemented,
                "a run in virtual time takes no other graph from an operator; start it without --pace and "
                "--view, with the time of the change: --change GRAPH.xml@TIME");
  return has_one_machine();
}

Status Applying::has_one_machine() const {
  if (place_.graph.machines.size() < 2) return ok();
  std::vector<std::string> machines;
  for (const graph::MachineNode& node : place_.graph.machines) machines.push_back(node.name);
  return fail(Code::unimplemented,
              "a system on several machines (" + listed(machines) +
                  ") takes no other graph while it runs; stop it, and start it with that one");
}

Result<Applying::Outcome> Applying::carry_out(const GraphSource& source, Way way, const Care& care) {
  if (Status free = can_change(); !free.ok()) return free.error();
  return Change(*this, way, care, source.text.has_value()).carry_out(source);
}

// Returns the graph as it would be written for what runs now.
graph::Graph Applying::present() const {
  graph::Graph present = place_.graph;
  for (graph::ComponentNode& node : present.components) {
    node.params = place_.operating.params_of(node);
    node.type = place_.exchanging.code_of(node).type;
  }
  return present;
}

}  // namespace orca::supervisor
