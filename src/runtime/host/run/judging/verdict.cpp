// SPDX-License-Identifier: LGPL-3.0-or-later
#include "orca/host/verdict.hpp"

#include "orca/base/text.hpp"

namespace orca::host {
namespace {

bool is_at_end(const ComponentReport& report) {
  return report.has_failed || report.state == ComponentState::work_done;
}

}  // namespace

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

std::vector<std::string> unfinished(const graph::Graph& graph, const Reports& reports) {
  std::vector<std::string> left;
  for (const std::string& name : graph.ends)
    if (const ComponentReport report = reports(name); !is_at_end(report))
      left.push_back(name + " (" + to_string(report.state) + ")");
  return left;
}

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

}  // namespace orca::host
