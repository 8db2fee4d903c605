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

/// The parameters of other components that a task sets for a while, and sets back.
///
/// Thread contract: as the component that has the task.
class Settings final : public Setter {
 public:
  /// @param host  of that component; it outlives this object.
  explicit Settings(ComponentHost& host) : host_(host) {}

  std::uint64_t order(const Step& step) override {
    return host_.set_peer({named(step.component), step.param, step.words});
  }
  std::optional<Ending> outcome(std::uint64_t number) override {
    const auto outcome = host_.take_set(number);
    if (!outcome) return std::nullopt;
    if (!*outcome) return Ending{false, outcome->error().text()};
    return Ending{true, **outcome};
  }
  void set_back(const Step& step, std::uint64_t number, const std::string& before) override {
    if (number != 0)
      awaited_.push_back({named(step.component), step.param, before, number});
    else
      set_back({named(step.component), step.param, before});
  }

  /// Reports the steps of a task that set what the graph does not let the component set.
  void check(const Task& task, xml::Diagnostics& diagnostics) const {
    for (const Step& step : task.steps) {
      const bool sets = step.kind == Kind::with && !step.component.empty();  // else it is a fault already
      if (!sets || host_.may_set(named(step.component), step.param)) continue;
      const std::string what = step.component + "." + step.param;
      diagnostics.error(codes::kRight, step.position,
                        "the graph does not let this task set " + what + "; add may_set=" + in_quotes(what) +
                            " to component " + in_quotes(host_.name()));
    }
  }

  /// Goes on with what is being set back. @return what could not be, for people.
  std::vector<std::string> go_on() {
    std::vector<std::string> faults;
    for (const Back& back : std::exchange(awaited_, {})) {
      const auto outcome = host_.take_set(back.number);
      if (!outcome)
        awaited_.push_back(back);
      else if (back.is_last && !*outcome && back.tries < kTries)
        set_back(back);
      else if (back.is_last && !*outcome)
        faults.push_back(back.component + "." + back.param + " is not set back to " + back.value + ": " +
                         outcome->error().text());
      else if (!back.is_last && *outcome)
        set_back({back.component, back.param, back.value.empty() ? **outcome : back.value});
    }
    return faults;
  }

  /// Returns whether something is still to be set back.
  [[nodiscard]] bool awaits() const { return !awaited_.empty(); }

 private:
  static constexpr int kTries = 3;

  // A parameter that is to be set back once an order about it has ended, or by that order itself.
  struct Back {
    std::string component;
    std::string param;
    std::string value;  // empty: the one before that order
    std::uint64_t number = 0;
    bool is_last = false;  // it is the order that sets it back
    int tries = 0;         // of that order
  };

  void set_back(Back back) {
    back.number = host_.set_peer({back.component, back.param, back.value});
    back.is_last = true;
    ++back.tries;
    awaited_.push_back(std::move(back));
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
