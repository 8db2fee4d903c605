// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rehearsal.hpp"

#include <algorithm>
#include <map>
#include <memory>
#include <set>
#include <utility>

#include "orca/host/last_words.hpp"
#include "orca/patterns/local/local_links.hpp"
#include "orca/plugin/trial.hpp"
#include "quiet_run.hpp"
#include "run/component_making.hpp"

namespace orca::host {
namespace {

using graph::ComponentFault;
using plugin::TrialLine;
using plugin::TrialResult;

constexpr Duration kLimit = 10s;       // of one trial: as long as the whole system has to come up
constexpr std::size_t kMostEnds = 50;  // of the copy, by its components
constexpr int kMostHangs = 2;          // each costs kLimit

// A fault on its way out of the copy. Its three texts contain no zeros, because they come from XML and from C++.
std::string packed(const ComponentFault& fault) {
  return fault.component + '\0' + fault.param + '\0' + fault.text;
}

ComponentFault unpacked(const std::string& bytes) {
  const std::size_t first = bytes.find('\0');
  const std::size_t second = bytes.find('\0', first + 1);
  return {bytes.substr(0, first), bytes.substr(first + 1, second - first - 1), bytes.substr(second + 1)};
}

// Returns whether the error cannot be due to the trial, in which hardware is closed.
// @param doubtful  others that the component needs may be missing, too.
bool counts(const Error& error, bool doubtful) {
  if (doubtful) return !error.param.empty() && error.code == Code::invalid_argument;
  const bool may_pass = error.code == Code::unavailable || error.code == Code::deadline_exceeded;
  return !error.param.empty() || !may_pass;
}

// The components of a graph in the copy of the process.
class Rehearsal {
 public:
  Rehearsal(const graph::Graph& graph, PluginCatalogue& catalogue, Executive& executive, TrialLine& line)
      : graph_(graph), executive_(executive), line_(line) {
    for (const graph::ComponentNode& node : graph.components) add(node, catalogue);
  }

  /// Connects the ports; false if they are not there.
  bool connect_all() {
    LocalLinks within_this_process;
    const auto find = [this](const std::string& name) { return components_.at(name).get(); };
    return sound_ && connect(graph_, find, within_this_process).ok();
  }

  /// Configures the components one after the other. Runs as the executive's main task.
  void configure(const std::vector<std::string>& names, const std::set<std::string>& doubtful) {
    for (const std::string& name : names)
      configure(*components_.at(name), doubtful.contains(name) || !can_come_up(name));
    line_.end();
  }

 private:
  void step(const std::string& component, Hook hook) { line_.step(packed({component, "", to_string(hook)})); }

  void add(const graph::ComponentNode& node, PluginCatalogue& catalogue) {
    step(node.name, Hook::constructor);
    ComponentSettings settings = settings_of(node);
    settings.on_demand = false;
    auto instance = std::make_unique<ComponentInstance>(
        quiet_.context(), std::move(settings),
        [&catalogue, type = node.type] { return catalogue.acquire(PluginKind::component, type); },
        [&catalogue](LoadedType type) { return catalogue.release(std::move(type)); },
        device_of(node, catalogue));
    sound_ = instance->load().ok() && sound_;
    components_[node.name] = std::move(instance);
    start_after_[node.name] = node.start_after;
  }

  Device* device_of(const graph::ComponentNode& node, PluginCatalogue& catalogue) const {
    const graph::HardwareNode* const hardware = graph_.find_hardware(node.hardware);
    if (hardware == nullptr) return nullptr;
    return catalogue.closed_hardware({hardware->name, hardware->type, hardware->params});
  }

  // Returns whether all components are up that must be up before this one.
  bool can_come_up(const std::string& name) const {
    const std::vector<std::string>& before = start_after_.at(name);
    return std::ranges::all_of(before, [&](const std::string& other) { return up_.contains(other); });
  }

  void configure(ComponentInstance& component, bool doubtful) {
    step(component.name(), Hook::configure);
    start(component);
    const auto left_init = [&] { return component.state() != ComponentState::init; };
    if (!wait_until_holds(executive_, *changed_, executive_.now() + kLimit, left_init)) {
      if (!doubtful) line_.find(packed({component.name(), "", "configure() did not return within 10 s"}));
    } else if (!component.has_failed()) {
      up_.insert(component.name());
    } else if (const std::optional<Error> error = component.refusal(); error && counts(*error, doubtful)) {
      Error placed = *error;
      placed.param.clear();
      line_.find(packed({component.name(), error->param, placed.text()}));
    }
  }

  // Without threads or memory nothing can be tried, which the start of the system will report.
  void start(ComponentInstance& component) {
    try {
      component.start();
    } catch (...) {
      line_.end();
    }
  }

  const graph::Graph& graph_;
  Executive& executive_;
  TrialLine& line_;
  const std::unique_ptr<Event> changed_ = executive_.make_event();
  std::atomic<std::uint64_t> missions_{0};
  QuietRun quiet_{executive_, "trial", graph_.seed.value_or(1), [this] { changed_->notify(); }, missions_};
  std::map<std::string, std::unique_ptr<ComponentInstance>> components_;
  std::map<std::string, std::vector<std::string>> start_after_;
  std::set<std::string> up_;
  bool sound_ = true;
};

// Nothing of it is ever destroyed, because the copy of the process ends here. Its components are fibers whatever the clock: one
// is configured at a time, and ten thousand threads would cost more than everything else.
void play(const graph::Graph& graph, const graph::Candidates& candidates, PluginCatalogue& catalogue,
          ClockKind clock, TrialLine& line) {
  LastWords::leave_copy();
  Result<std::unique_ptr<Executive>> made = make_executive({clock, Backend::fiber});
  if (!made) return;
  Executive& executive = *std::move(made).value().release();
  auto& rehearsal = *new Rehearsal(graph, catalogue, executive, line);
  if (rehearsal.connect_all())
    executive.run([&] { rehearsal.configure(candidates.names, candidates.doubtful); });
}

// The trials of one graph, and what they have found.
class Trials {
 public:
  explicit Trials(const graph::Candidates& all) : all_(all), left_(all) {}

  /// Returns the components that are still to be tried, together.
  [[nodiscard]] const graph::Candidates& left() const { return left_; }

  /// Takes the findings of a trial. Returns whether another one without its culprit makes sense.
  bool take(const TrialResult& tried) {
    for (const std::string& bytes : tried.findings) add(unpacked(bytes));
    const bool ended_early =
        tried.ending != TrialResult::Ending::well && tried.ending != TrialResult::Ending::silent;
    if (!ended_early || tried.last_step.empty()) return false;
    const ComponentFault culprit = unpacked(tried.last_step);  // its text is the hook
    if (tried.ending == TrialResult::Ending::too_long) ++hangs_;
    if (tried.ending != TrialResult::Ending::effect && !all_.doubtful.contains(culprit.component))
      add({culprit.component, "", culprit.text + " " + tried.text});
    if (culprit.text == to_string(Hook::constructor)) return false;  // each trial makes all objects
    std::erase(left_.names, culprit.component);
    return ++ends_ < kMostEnds && hangs_ < kMostHangs;
  }

  [[nodiscard]] std::vector<ComponentFault> faults() const {
    std::vector<ComponentFault> result;
    for (const std::string& name : all_.names)
      if (const auto found = faults_.find(name); found != faults_.end()) result.push_back(found->second);
    return result;
  }

 private:
  void add(ComponentFault fault) { faults_.insert_or_assign(fault.component, fault); }

  const graph::Candidates& all_;
  graph::Candidates left_;
  std::map<std::string, ComponentFault> faults_;
  std::size_t ends_ = 0;
  int hangs_ = 0;
};

}  // namespace

std::vector<ComponentFault> rehearse(const graph::Graph& graph, const graph::Candidates& candidates,
                                     PluginCatalogue& catalogue, ClockKind clock,
                                     const std::function<bool()>& give_up) {
#if defined(__SANITIZE_THREAD__)
  constexpr bool kPossible = false;
#else
  constexpr bool kPossible = true;
#endif
  Trials trials(candidates);
  for (bool more = kPossible && !candidates.names.empty(); more;)
    more = trials.take(
        plugin::run_trial([&](TrialLine& line) { play(graph, trials.left(), catalogue, clock, line); },
                          kLimit, plugin::Effects::none, give_up));
  return trials.faults();
}

}  // namespace orca::host
