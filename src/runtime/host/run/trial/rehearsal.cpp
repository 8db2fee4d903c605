// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rehearsal.hpp"

#include <algorithm>
#include <map>
#include <memory>
#include <set>
#include <tuple>
#include <utility>

#include "orca/host/last_words.hpp"
#include "orca/patterns/local/local_links.hpp"
#include "orca/plugin/trial.hpp"
#include "quiet_run.hpp"
#include "run/system/component_making.hpp"
#include "run/system/topics.hpp"

namespace orca::host {
namespace {

using graph::ComponentFault;
using plugin::TrialLine;
using plugin::TrialResult;

constexpr Duration kLimit = 10s;        // of one trial: as long as the whole system has to come up
constexpr std::uint64_t kSeed = 1;      // as of a run that is given none
constexpr std::size_t kMostEnds = 50;   // of the copy, by its components
constexpr int kMostHangs = 2;           // each costs kLimit
constexpr std::size_t kMostAlike = 50;  // of components that differ in their names and partners only
constexpr std::size_t kMostAtOnce =
    1000;  // in one copy, so that ten thousand do not take ten thousand's memory

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
    const auto find = [this](const std::string& name) { return components_.at(name).get(); };
    if (!sound_ || !connect(graph_, find, [](const graph::Edge&) { return LocalLinks(); }).ok()) return false;
    return std::ranges::all_of(graph_.components, [this](const graph::ComponentNode& node) {
      return connect_silence(node, *components_.at(node.name)).ok();
    });
  }

  /// Configures the components one after the other. Runs as the executive's main task.
  /// @param down  those that did not come up in earlier trials.
  void configure(const std::vector<std::string>& names, const std::set<std::string>& doubtful,
                 std::set<std::string> down) {
    down_ = std::move(down);
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
    plugin::DescribedHardware* const closed =
        catalogue.closed_hardware({hardware->name, hardware->type, hardware->params});
    return closed == nullptr ? nullptr : &closed->seat();
  }

  // Returns whether all components are up that must be up before this one.
  bool can_come_up(const std::string& name) const {
    const std::vector<std::string>& before = start_after_.at(name);
    return std::ranges::none_of(before, [&](const std::string& other) { return down_.contains(other); });
  }

  void configure(ComponentInstance& component, bool doubtful) {
    step(component.name(), Hook::configure);
    start(component);
    const auto left_init = [&] { return component.state() != ComponentState::init; };
    ComponentFault found{component.name(), "", ""};  // without a text: it is down, and that is no fault
    if (!wait_until_holds(executive_, *changed_, executive_.now() + kLimit, left_init)) {
      if (!doubtful) found.text = "configure() did not return within 10 s";
    } else if (!component.has_failed()) {
      return;
    } else if (const std::optional<Error> error = component.refusal(); error && counts(*error, doubtful)) {
      Error placed = *error;
      placed.param.clear();
      found = {component.name(), error->param, placed.text()};
    }
    down_.insert(component.name());
    line_.find(packed(found));
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
  QuietRun quiet_{executive_, "trial", kSeed, [this] { changed_->notify(); }, missions_};
  std::map<std::string, std::unique_ptr<ComponentInstance>> components_;
  std::map<std::string, std::vector<std::string>> start_after_;
  std::set<std::string> down_;
  bool sound_ = true;
};

// Returns a graph of these components and what they are connected to: of partners that are not among them, at most kMostAlike at
// each port.
graph::Graph part_of(const graph::Graph& graph, const std::vector<std::string>& names) {
  const std::set<std::string> tried(names.begin(), names.end());
  std::set<std::string> wanted = tried;
  std::map<std::string, std::size_t> partners;  // by port
  graph::Graph part;
  part.hardware = graph.hardware;
  for (const graph::Edge& edge : graph.edges) {
    const bool has_from = tried.contains(edge.from.component);
    const bool has_to = tried.contains(edge.to.component);
    if (!has_from && !has_to) continue;
    const bool is_between = has_from && has_to;
    if (!is_between && ++partners[(has_from ? edge.from : edge.to).text()] > kMostAlike) continue;
    wanted.insert({edge.from.component, edge.to.component});
    part.edges.push_back(edge);
  }
  for (const graph::ComponentNode& node : graph.components)
    if (wanted.contains(node.name)) part.components.push_back(node);
  return part;
}

// What is to be tried in one copy of the process.
struct Turn {
  std::vector<std::string> names;
  const std::set<std::string>& doubtful;
  const std::set<std::string>& down;
};

// Nothing of it is ever destroyed, because the copy of the process ends here. Its components are fibers whatever the clock: one
// is configured at a time, and ten thousand threads would cost more than everything else.
void play(const graph::Graph& graph, const Turn& turn, PluginCatalogue& catalogue, ClockKind clock,
          TrialLine& line) {
  LastWords::leave_copy();
  Result<std::unique_ptr<Executive>> made = make_executive({clock, Backend::fiber});
  if (!made) return;
  Executive& executive = *std::move(made).value().release();
  const graph::Graph& part = *new graph::Graph(part_of(graph, turn.names));
  auto& rehearsal = *new Rehearsal(part, catalogue, executive, line);
  if (rehearsal.connect_all())
    executive.run([&] { rehearsal.configure(turn.names, turn.doubtful, turn.down); });
}

// Returns the components that are to be tried: all, but not more than kMostAlike of a kind.
std::vector<std::string> without_more_of_a_kind(const graph::Graph& graph,
                                                const std::vector<std::string>& names) {
  std::map<std::string, std::vector<std::string>> ports;  // connected ones, by component
  for (const graph::Edge& edge : graph.edges) {
    ports[edge.from.component].push_back(edge.from.port);
    ports[edge.to.component].push_back(edge.to.port);
  }
  using Kind = std::tuple<std::string, std::string, std::string, graph::Params, std::vector<std::string>>;
  std::map<Kind, std::size_t> seen;
  const std::set<std::string> wanted(names.begin(), names.end());
  std::set<std::string> surplus;
  for (const graph::ComponentNode& node : graph.components)
    if (wanted.contains(node.name) &&
        ++seen[{node.type, node.hardware, node.process, node.params, ports[node.name]}] > kMostAlike)
      surplus.insert(node.name);
  std::vector<std::string> kept = names;
  std::erase_if(kept, [&](const std::string& name) { return surplus.contains(name); });
  return kept;
}

// Returns all that a trial depends on, besides the files that it reads and the components at other ends.
TrialSubject subject(const graph::Graph& graph, const std::string& name) {
  TrialSubject subject{*graph.find_component(name), {}, {}};
  if (const auto* const hardware = graph.find_hardware(subject.component.hardware))
    subject.hardware = *hardware;
  for (const graph::Edge& edge : graph.edges) {
    if (edge.from.component == name) subject.ports.push_back(edge.from.port);
    if (edge.to.component == name) subject.ports.push_back(edge.to.port);
  }
  subject.component.name.clear();
  subject.component.position = subject.hardware.position = {};
  return subject;
}

// The trials of one graph, and what they have found.
class Trials {
 public:
  /// @param names  those of the candidates that are to be tried.
  Trials(const graph::Candidates& all, std::vector<std::string> names) : all_(all), left_(std::move(names)) {}

  [[nodiscard]] bool has_more() const { return !left_.empty(); }

  /// Returns what is to be tried next.
  [[nodiscard]] Turn next() const {
    const auto end = left_.begin() + static_cast<std::ptrdiff_t>(std::min(left_.size(), kMostAtOnce));
    return {{left_.begin(), end}, all_.doubtful, down_};
  }

  /// Takes the findings of the trial of next(). Returns whether another one makes sense, without its culprit if it had one.
  bool take(const TrialResult& tried) {
    for (const std::string& bytes : tried.findings) add(unpacked(bytes));
    const bool ended_early =
        tried.ending != TrialResult::Ending::well && tried.ending != TrialResult::Ending::silent;
    if (!ended_early) {
      left_.erase(left_.begin(), left_.begin() + static_cast<std::ptrdiff_t>(next().names.size()));
      return has_more();
    }
    if (tried.last_step.empty()) return false;
    const ComponentFault culprit = unpacked(tried.last_step);  // its text is the hook
    if (tried.ending == TrialResult::Ending::too_long) ++hangs_;
    if (tried.ending != TrialResult::Ending::effect && !all_.doubtful.contains(culprit.component))
      add({culprit.component, "", culprit.text + " " + tried.text});
    if (culprit.text == to_string(Hook::constructor)) return false;  // each trial makes all objects
    std::erase(left_, culprit.component);
    down_.insert(culprit.component);
    return ++ends_ < kMostEnds && hangs_ < kMostHangs;
  }

  /// Returns whether a component that was tried came up, and nothing that it needs may be missing.
  [[nodiscard]] bool stood(const std::string& name) const {
    return !all_.doubtful.contains(name) && !down_.contains(name);
  }

  [[nodiscard]] std::vector<ComponentFault> faults() const {
    std::vector<ComponentFault> result;
    for (const std::string& name : all_.names)
      if (const auto found = faults_.find(name); found != faults_.end()) result.push_back(found->second);
    return result;
  }

 private:
  void add(const ComponentFault& fault) {
    down_.insert(fault.component);
    if (!fault.text.empty()) faults_.insert_or_assign(fault.component, fault);
  }

  const graph::Candidates& all_;
  std::vector<std::string> left_;
  std::set<std::string> down_;  // did not come up
  std::map<std::string, ComponentFault> faults_;
  std::size_t ends_ = 0;
  int hangs_ = 0;
};

}  // namespace

std::vector<ComponentFault> rehearse(const graph::Graph& graph, const graph::Candidates& candidates,
                                     PluginCatalogue& catalogue, ClockKind clock,
                                     const std::function<bool()>& give_up, TrialsStood& stood) {
#if defined(__SANITIZE_THREAD__)
  constexpr bool kPossible = false;
#else
  constexpr bool kPossible = true;
#endif
  std::vector<std::string> names = without_more_of_a_kind(graph, candidates.names);
  std::erase_if(names, [&](const std::string& name) {
    return !candidates.doubtful.contains(name) && stood.holds(subject(graph, name));
  });
  Trials trials(candidates, names);
  for (bool more = kPossible && trials.has_more(); more;)
    more = trials.take(
        plugin::run_trial([&](TrialLine& line) { play(graph, trials.next(), catalogue, clock, line); },
                          kLimit, plugin::Effects::none, give_up));
  for (const std::string& name : names)
    if (kPossible && !trials.has_more() && trials.stood(name)) stood.add(subject(graph, name));
  return trials.faults();
}

}  // namespace orca::host
