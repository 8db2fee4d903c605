// SPDX-License-Identifier: LGPL-3.0-or-later
#include "orca/host/conclusion.hpp"

#include <vector>

#include "orca/base/log.hpp"
#include "orca/base/text.hpp"

namespace orca::host {
namespace {

constexpr const char* kMayFailHint =
    "ended in WORK_FAILED, so the run has failed; if it may, say so in the graph with may_fail=\"true\"";

bool is_at_end(const ComponentReport& report) {
  return report.has_failed || report.state == ComponentState::work_done;
}

// Returns how the run ended if the components that the graph names in `ends` have come to an end: all are done, or one that may
// not fail has failed, which is the error.
std::optional<Status> ending(const graph::Graph& graph, const Reports& reports) {
  if (graph.ends.empty()) return std::nullopt;
  bool all_done = true;
  for (const std::string& name : graph.ends) {
    const ComponentReport report = reports(name);
    if (report.has_failed && !graph.find_component(name)->may_fail)
      return Status(fail(Code::failed_precondition, report.failure, name));
    all_done = all_done && is_at_end(report);
  }
  return all_done ? std::optional<Status>(ok()) : std::nullopt;
}

// Returns the components for which the end of the run still waits, for people: "command (WORK)".
std::vector<std::string> unfinished(const graph::Graph& graph, const Reports& reports) {
  std::vector<std::string> left;
  for (const std::string& name : graph.ends)
    if (const ComponentReport report = reports(name); !is_at_end(report))
      left.push_back(name + " (" + to_string(report.state) + ")");
  return left;
}

// Returns the components whose last work ended in WORK_FAILED although the graph does not allow it.
std::vector<std::string> failed_components(const graph::Graph& graph, const Reports& reports) {
  std::vector<std::string> failed;
  for (const graph::ComponentNode& node : graph.components)
    if (!node.may_fail && reports(node.name).ended_badly) failed.push_back(node.name);
  return failed;
}

Error failure_of(const std::vector<std::string>& failed, const Reports& reports) {
  if (failed.size() > 1) return fail(Code::failed_precondition, listed(failed) + " ended in WORK_FAILED");
  return fail(Code::failed_precondition, reports(failed.front()).failure, failed.front());
}

}  // namespace

void Conclusion::conclude(RunOutcome outcome, const Status& status) {
  is_over_ = true;
  outcome_ = outcome;
  if (!status.ok()) error_ = status.error();
  if (told_) told_(outcome, error_ ? error_->text() : "");
}

void Conclusion::fail_with(const Error& error) {
  conclude(came_up_ ? RunOutcome::failed : RunOutcome::not_started, error);
}

void Conclusion::report_failure(const Error& error) {
  log::error(log_name_, error.text());
  fail_with(error);
}

// A component that has failed has said itself why.
void Conclusion::refuse_start(const Error& error) {
  const bool is_component = graph_.find_component(error.where) != nullptr;
  if (!is_component || !reports_(error.where).has_failed) log::error(log_name_, error.text());
  log::error(log_name_, "not everything came up; taking all down again");
  fail_with(error);
}

void Conclusion::stop(const std::string& signal) {
  if (signal.empty()) return conclude(RunOutcome::stopped, ok());
  const Error error = fail(Code::failed_precondition, "the signal " + signal + " ended the run");
  log::error(log_name_, error.text());
  conclude(RunOutcome::failed, error);
}

void Conclusion::run_out_of_time() {
  conclude(RunOutcome::time_is_up, ok());
  if (!graph_.ends.empty())
    say_(log::Level::info, log_name_,
         "the time limit has ended the run before these were done: " + listed(unfinished(graph_, reports_)));
}

void Conclusion::look_at_ends(const std::function<bool(bool is_done_here)>& everywhere) {
  std::optional<Status> end = ending(graph_, reports_);
  if (everywhere && (!end || end->ok()))
    end = everywhere(end.has_value()) ? std::optional<Status>(ok()) : std::nullopt;
  if (!end) return;
  by_components_ = true;
  conclude(end->ok() ? RunOutcome::finished : RunOutcome::failed, *end);
}

void Conclusion::judge() {
  if (error_) return;
  const std::vector<std::string> failed = failed_components(graph_, reports_);
  for (const std::string& name : failed) say_(log::Level::error, name, kMayFailHint);
  if (!failed.empty()) conclude(RunOutcome::failed, failure_of(failed, reports_));
}

void Conclusion::fail_late(const Error& error) {
  if (came_up_ && !error_) conclude(RunOutcome::failed, error);
}

void Conclusion::fill(RunResult& result) const {
  result.outcome = outcome_;
  result.error = error_;
  if (error_ && (graph_.find_component(error_->where) || graph_.find_hardware(error_->where)))
    result.culprit = error_->where;
}

}  // namespace orca::host
