// SPDX-License-Identifier: LGPL-3.0-or-later
#include "checking/checks.hpp"

#include <algorithm>

#include "reading/codes.hpp"

namespace orca::graph {
namespace {

// A search that follows start_after from component to component and finds its cycles.
class CycleSearch {
 public:
  CycleSearch(const Model& model, Report& report)
      : model_(model), report_(report), state_(model.components.size(), State::fresh) {}

  void run() {
    for (std::size_t i = 0; i < state_.size(); ++i)
      if (state_[i] == State::fresh) walk(i);
  }

 private:
  enum class State { fresh, on_path, done };
  struct Step {
    std::size_t component;
    std::size_t next = 0;  // index of the next start_after to look at
  };

  // Searches depth first with its own stack, because ten thousand components in a row must not need as many
  // stack frames.
  void walk(std::size_t start) {
    enter(start);
    while (!path_.empty()) {
      Step& step = path_.back();
      const auto& before = model_.components[step.component].value.start_after;
      if (step.next == before.size()) {
        state_[step.component] = State::done;
        path_.pop_back();
      } else {
        visit(before[step.next++]);
      }
    }
  }

  void visit(const std::string& name) {
    const auto found = model_.component_by_name.find(name);
    if (found == model_.component_by_name.end()) return;
    const State state = state_[found->second];
    if (state == State::on_path) report_cycle(found->second);
    if (state == State::fresh) enter(found->second);
  }

  void enter(std::size_t component) {
    state_[component] = State::on_path;
    path_.push_back({component});
  }

  void report_cycle(std::size_t closing) {
    const auto first = std::ranges::find(path_, closing, &Step::component);
    constexpr std::ptrdiff_t kShown = 12;
    std::string circle;
    for (auto step = first; step != path_.end() && step - first < kShown; ++step)
      circle += name(step->component) + " -> ";
    if (path_.end() - first > kShown) circle += std::to_string(path_.end() - first - kShown) + " more -> ";
    report_.error(
        codes::kCycle, model_.components[closing].value.position,
        "start_after goes in a circle: " + circle + name(closing) + "; none of them could start first");
  }

  const std::string& name(std::size_t component) const { return model_.components[component].value.name; }

  const Model& model_;
  Report& report_;
  std::vector<State> state_;
  std::vector<Step> path_;
};

}  // namespace

void check_start_order(const Model& model, Report& report) { CycleSearch(model, report).run(); }

}  // namespace orca::graph
