// SPDX-License-Identifier: LGPL-3.0-or-later
#include "checking/checks.hpp"

#include <algorithm>
#include <string>

#include "orca/base/text.hpp"
#include "reading/codes.hpp"

namespace orca::graph {
namespace {

constexpr const char* kRemedy = "; take start=\"on_demand\" away, or put it into another process";

// A check of one process that is started on demand.
class DemandCheck {
 public:
  DemandCheck(const ProcessNode& process, const Model& model, const Graph& graph, Report& report)
      : process_(process), model_(model), graph_(graph), report_(report) {}

  void run() {
    check_surroundings();
    for (const CheckedHardware& hardware : model_.hardware) check(hardware);
    for (const CheckedComponent& component : model_.components) check(component);
    check_edges();
  }

 private:
  [[nodiscard]] std::string title() const {
    return "the process " + in_quotes(process_.name) + " is started on demand";
  }

  void error(const xml::Position& place, const std::string& text) {
    report_.error(codes::kLoading, place, text);
  }

  // What wakes such a process is the supervisor of its machine.
  void check_surroundings() {
    if (!model_.machines.empty())
      error(process_.position,
            title() + ", which a graph of several machines cannot do yet; take start=\"on_demand\" away");
    if (graph_.supervision.on_supervisor_loss == OnLoss::go_on)
      error(process_.position, title() +
                                   ", and without a supervisor nobody starts it; take start=\"on_demand\" or "
                                   "on_supervisor_loss=\"continue\" away");
  }

  void check(const CheckedHardware& hardware) {
    if (hardware.value.process != process_.name) return;
    error(hardware.value.position, "hardware " + in_quotes(hardware.value.name) + ": " + title() +
                                       ", and hardware must be open before anything begins to work" +
                                       kRemedy);
  }

  void check(const CheckedComponent& component) {
    if (!is_in(component)) return;
    const std::string begin = "component " + in_quotes(component.value.name) + ": " + title();
    if (component.value.autonomous.value_or(false))
      error(component.value.position,
            begin + ", and it is autonomous, so it works whether asked for or not" + kRemedy);
    if (std::ranges::find(graph_.ends, component.value.name) != graph_.ends.end())
      error(component.value.position,
            begin + ", and the run ends with it, so it must run from the start" + kRemedy);
  }

  void check_edges() {
    bool can_wake = false;
    for (const Edge& edge : graph_.edges) {
      const bool push = edge.pattern == Pattern::push;
      if (!is_here(push ? edge.from : edge.to) || is_here(push ? edge.to : edge.from)) continue;
      can_wake = true;
      if (edge.link == Link::dds && !model_.any_link)
        error(edge.position, "cannot connect " + in_quotes(edge.from.text()) + " to " +
                                 in_quotes(edge.to.text()) + " by link=\"dds\": " + title() +
                                 ", and only link=\"shm\" can wake it");
    }
    if (!can_wake && report_.no_errors())
      report_.warning(codes::kNothingRuns, process_.position,
                      title() + ", and no other process uses anything in it, so it is never started");
  }

  [[nodiscard]] bool is_in(const CheckedComponent& component) const {
    return component.process_known && component.value.process == process_.name;
  }

  [[nodiscard]] bool is_here(const PortRef& port) const {
    const CheckedComponent* const component = model_.component(port.component);
    return component != nullptr && is_in(*component);
  }

  const ProcessNode& process_;
  const Model& model_;
  const Graph& graph_;
  Report& report_;
};

}  // namespace

void check_demand(const Model& model, const Graph& graph, Report& report) {
  bool any = false;
  for (const CheckedProcess& process : model.processes) {
    if (!process.value.on_demand) continue;
    any = true;
    DemandCheck(process.value, model, graph, report).run();
  }
  const auto runs_at_once = [&](const CheckedComponent& component) {
    const CheckedProcess* const process = model.find_process(component.value.process);
    return !component.process_known || process == nullptr || !process->value.on_demand;
  };
  if (any && std::ranges::none_of(model.components, runs_at_once))
    report.error(codes::kLoading, model.processes.front().value.position,
                 "all processes are started on demand, so nothing would ever be; let one run from the start");
}

}  // namespace orca::graph
