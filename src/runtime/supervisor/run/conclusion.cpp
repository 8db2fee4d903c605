// SPDX-License-Identifier: LGPL-3.0-or-later
#include "conclusion.hpp"

#include <vector>

#include "orca/base/log.hpp"
#include "orca/base/text.hpp"
#include "orca/host/verdict.hpp"

namespace orca::supervisor {

using host::RunOutcome;

void Conclusion::conclude(RunOutcome outcome, const Status& status) {
  is_over_ = true;
  outcome_ = outcome;
  if (!status.ok()) error_ = status.error();
  if (told_) told_(outcome, error_ ? error_->text() : "");
}

void Conclusion::fail_with(const Error& error) {
  conclude(came_up_ ? RunOutcome::failed : RunOutcome::not_started, error);
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
    log::info(log_name_, "the time limit has ended the run before these were done: " +
                             listed(host::unfinished(graph_, reports_)));
}

void Conclusion::look_at_ends(const std::function<bool(bool is_done_here)>& everywhere) {
  std::optional<Status> end = host::ending(graph_, reports_);
  if (everywhere && (!end || end->ok()))
    end = everywhere(end.has_value()) ? std::optional<Status>(ok()) : std::nullopt;
  if (!end) return;
  by_components_ = true;
  conclude(end->ok() ? RunOutcome::finished : RunOutcome::failed, *end);
}

void Conclusion::judge() {
  if (error_) return;
  const std::vector<std::string> failed = host::failed_components(graph_, reports_);
  for (const std::string& name : failed) log::error(name, host::kMayFailHint);
  if (!failed.empty()) conclude(RunOutcome::failed, host::failure_of(failed, reports_));
}

void Conclusion::fail_late(const Error& error) {
  if (came_up_ && !error_) conclude(RunOutcome::failed, error);
}

void Conclusion::fill(host::RunResult& result) const {
  result.outcome = outcome_;
  result.error = error_;
  if (error_ && (graph_.find_component(error_->where) || graph_.find_hardware(error_->where)))
    result.culprit = error_->where;
}

}  // namespace orca::supervisor
