// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "orca/base/text.hpp"
#include "orca/component.hpp"
#include "task_rules.hpp"
#include "task_run.hpp"

namespace orca::tasks {

/// The changes of a task to other components, for a while: parameters, and who is suspended.
///
/// Thread contract: as the component that has the task.
class Settings final : public Setter {
 public:
  /// @param host  of that component; it outlives this object.
  explicit Settings(ComponentHost& host) : host_(host) {}

  std::uint64_t order(const Step& step) override { return host_.order_peer(order_of(step)); }
  std::optional<Ending> outcome(std::uint64_t number) override {
    const auto outcome = host_.take_outcome(number);
    if (!outcome) return std::nullopt;
    if (!*outcome) return Ending{false, outcome->error().text()};
    return Ending{true, **outcome};
  }
  void set_back(const Step& step, std::uint64_t number, const std::string& before) override {
    if (number != 0)
      awaited_.push_back({order_of(step), before, number});
    else
      set_back({order_of(step), before});
  }

  /// Looks after an order of an earlier object: it is carried out still, or has ended, or was lost with its process. After each of the
  /// last two it is to be given again.
  void settle(TaskRun::Memory& memory) {
    const std::optional<Ending> ending = memory.order == 0 ? std::nullopt : outcome(memory.order);
    if (!ending) return;
    memory.order = 0;
    if (ending->done && memory.before.empty()) memory.before = ending->reason;
  }

  /// Reports the steps of a task that change what the graph does not let the component change.
  void check(const Task& task, xml::Diagnostics& diagnostics) const {
    for (const Step& step : task.steps) {
      const bool sets = step.kind == Kind::with;
      if ((!sets && step.kind != Kind::suspend) || step.component.empty()) continue;  // it is a fault already
      const std::string name = named(step.component);
      if (sets ? host_.may_set(name, step.param) : host_.may_suspend(name)) continue;
      const std::string what = sets ? step.component + "." + step.param : step.component;
      diagnostics.error(codes::kRight, step.position,
                        "the graph does not let this task " + std::string(sets ? "set " : "suspend ") + what +
                            "; add " + (sets ? "may_set=" : "may_suspend=") + in_quotes(what) +
                            " to component " + in_quotes(host_.name()));
    }
  }

  /// Goes on with what is being changed back. @return what could not be, for people.
  std::vector<std::string> go_on() {
    std::vector<std::string> faults;
    for (const Back& back : std::exchange(awaited_, {})) {
      const auto outcome = host_.take_outcome(back.number);
      if (!outcome)
        awaited_.push_back(back);
      else if (back.is_last && !*outcome && back.tries < kTries)
        set_back(back);
      else if (back.is_last && !*outcome)
        faults.push_back(fault_of(back) + ": " + outcome->error().text());
      else if (!back.is_last && *outcome)
        set_back({back.order, back.before.empty() ? **outcome : back.before});
    }
    return faults;
  }

  /// Returns whether something is still to be changed back.
  [[nodiscard]] bool awaits() const { return !awaited_.empty(); }

 private:
  static constexpr int kTries = 3;

  // Something that is to be changed back once an order about it has ended, or by that order itself.
  struct Back {
    PeerOrder order;     // that changed it
    std::string before;  // what was so before; empty: the outcome of that order
    std::uint64_t number = 0;
    bool is_last = false;  // it is the order that changes it back
    int tries = 0;         // of that order
  };

  void set_back(Back back) {
    PeerOrder order = back.order;
    if (order.kind == PeerOrder::Kind::set) {
      order.value = back.before;
    } else {
      if (back.before == kPeerIsSuspended) return;  // somebody else has suspended it
      order.kind = PeerOrder::Kind::resume;
    }
    back.number = host_.order_peer(order);
    back.is_last = true;
    ++back.tries;
    awaited_.push_back(std::move(back));
  }

  static std::string fault_of(const Back& back) {
    const PeerOrder& order = back.order;
    if (order.kind == PeerOrder::Kind::set)
      return order.component + "." + order.param + " is not set back to " + back.before;
    return order.component + " is not resumed";
  }

  [[nodiscard]] PeerOrder order_of(const Step& step) const {
    const bool sets = step.kind == Kind::with;
    return {sets ? PeerOrder::Kind::set : PeerOrder::Kind::suspend, named(step.component), step.param,
            step.words};
  }

  // Tasks name the components of the graph that they belong to; one that is included has a name before them.
  [[nodiscard]] std::string named(const std::string& component) const {
    const std::string own(host_.name());
    const std::size_t dot = own.rfind('.');
    return dot == std::string::npos ? component : own.substr(0, dot + 1) + component;
  }

  ComponentHost& host_;
  std::vector<Back> awaited_;
};

}  // namespace orca::tasks
