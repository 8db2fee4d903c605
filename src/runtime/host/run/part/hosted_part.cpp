// SPDX-License-Identifier: LGPL-3.0-or-later
#include "orca/host/hosted_part.hpp"

#include <algorithm>
#include <optional>
#include <string>
#include <utility>

#include "containment/environment.hpp"
#include "orca/base/exhaustion.hpp"
#include "orca/base/mutex.hpp"
#include "orca/base/text.hpp"
#include "orca/graph/placement.hpp"
#include "orca/graph/port_list.hpp"
#include "orca/host/last_words.hpp"
#include "order_box.hpp"
#include "outer_edges.hpp"
#include "outer_ports.hpp"
#include "part_changes.hpp"
#include "run/recording/run_files.hpp"
#include "run/reporting/sightings.hpp"
#include "run/swap/rewiring.hpp"
#include "run/swap/swaps.hpp"
#include "run/system/system.hpp"
#include "run/system/watched_system.hpp"

namespace orca::host {
namespace {

constexpr Duration kOrderLimit = 5s;

SystemOptions system_options(const PartOptions& options, PartListener& listener) {
  return {.seed = options.seed,
          .scene = {.moments = !options.outputs.picture.file.empty(), .motion = false},
          .failures = options.failures,
          .log_name = options.log_name,
          .missions = options.missions,
          .doorbell = options.doorbell,
          .state_sink = [&listener](const std::string& component,
                                    const KeptState& state) { listener.state_kept(component, state); },
          .states = options.states,
          .run = options.run};
}

}  // namespace

class HostedPart::Inside {
 public:
  Inside(const graph::Graph& whole, const std::string& process, const PartPlace& place,
         const PartOptions& options)
      : process_(process),
        part_(graph::subgraph(whole, process)),
        place_(place),
        whole_(whole),
        hang_limit_(options.hang_limit),
        outputs_(options.outputs),
        files_(place.executive),
        ports_(place.executive, options.missions),
        outer_(
            whole_, process, options.doorbell, options.run, options.clock_ahead,
            [this]() -> Reporter& { return watched_.reporter(); }, place.listener),
        watched_(part_, {place.catalogue, place.executive, files_.trace(), place.listener},
                 system_options(options, place.listener), [this] { return orders_.is_to_end(); }),
        swaps_(
            whole_, watched_.context(), place.catalogue, watched_.system(),
            [this](const std::string& component, const std::string& text) { stand_still(component, text); }) {
    watched_.reporter().tap(ports_.taps());
  }

  WatchedSystem& watched() { return watched_; }
  [[nodiscard]] RunCounters counters() {
    const MutexLock lock(graph_mutex_);
    return collect_counters(whole_, watched_.system());
  }
  OuterEdges& outer() { return outer_; }

  Result<std::shared_ptr<PortTap>> tap(const std::vector<graph::PortRef>& ports,
                                       const PortTap::Bounds& bounds) {
    const MutexLock lock(graph_mutex_);
    return ports_.tap(watched_.system(), ports, bounds, [](const graph::PortRef&) { return true; });
  }

  Status offer(const graph::PortRef& port, ObjectLoan object,
               std::function<void(Result<ObjectRef>)> answered) {
    const MutexLock lock(graph_mutex_);
    return ports_.offer(watched_.system(), port, std::move(object), std::move(answered));
  }

  Status build(std::map<std::string, Descriptor> memory) {
    if (Status opened = open_outputs(); !opened.ok()) return opened;
    if (Status known = outer_.prepare(std::move(memory), place_.catalogue); !known.ok()) return known;
    if (Status built = watched_.build(); !built.ok()) return built;
    return outer_.connect(watched_.system());
  }

  void run() {
    watched_.run([this] { obey(); }, [this](const std::string& component,
                                            const std::string& text) { stand_still(component, text); });
  }

  void write_outputs() {
    if (!outputs_.picture.file.empty()) {
      const Status drawn = write_picture(watched_.scene(), outputs_.picture, files_.picture());
      if (!drawn.ok()) fail_output(drawn.error());
    }
    close_outputs();
  }

  Status move(const std::string& name) {
    const MutexLock lock(graph_mutex_);
    const auto edge = std::ranges::find(whole_.edges, name, &graph::Edge::name);
    if (edge == whole_.edges.end()) return fail(Code::not_found, "an edge that the graph does not have");
    return host::move(watched_.system(), *edge);
  }

  void prepare_for_death() {
    watched_.stop_motors();
    files_.close_at_once();
  }

  [[nodiscard]] RunGlance look() const {
    RunGlance glance;
    for (RunGlance::Unwell& unwell : watched_.system().unwell())
      if (part_.find_hardware(unwell.name) != nullptr) glance.unwell.push_back(std::move(unwell));
    glance.goals = sightings_.goals();
    return glance;
  }

  void order(PartOrder order) { orders_.put(std::move(order)); }

 private:
  Status open_outputs() {
    const auto ports = outputs_.recordings.empty() ? std::vector<graph::ListedPort>{}
                                                   : graph::list_ports(whole_, place_.catalogue);
    if (Status opened = files_.open(outputs_, ports, {}); !opened.ok()) return opened;
    if (outputs_.looks_on) watched_.reporter().look_on(sightings_);
    if (!outputs_.recordings.empty()) watched_.reporter().record(files_.recorder());
    return ok();
  }

  void close_outputs() {
    for (const Error& error : files_.close()) fail_output(error);
  }

  void fail_output(const Error& error) {
    watched_.reporter().log_error(error.text());
    place_.listener.output_failed(error);
  }

  void obey() {
    while (!taken_down_) {
      report_changes();
      if (std::optional<PartOrder> order = orders_.take()) {
        carry_out(*order);
      } else {
        const TimePoint next = swaps_.go_on();
        watch_hangs();
        watched_.changed().wait_until(next);
      }
    }
    report_changes();
    orders_.close(end_);
  }

  void carry_out(const PartOrder& order) {
    if (order.kind == PartOrder::Kind::swap) return begin_swap(order);
    const Status outcome = contain_exhaustion([&] { return act(order); });
    report_changes();
    if (order.done) order.done(outcome);
  }

  void begin_swap(const PartOrder& order) {
    if (whole_.find_hardware(order.swap->component) != nullptr) watched_.set_hang_limit(Duration{0});
    swaps_.begin(std::move(*order.swap), order.swapped);
  }

  // A driver that waits for its device in calls of the system has the limit of its exchange.
  void watch_hangs() {
    if (is_open_) watched_.set_hang_limit(swaps_.concern_drivers() ? Duration{0} : hang_limit_);
  }

  Status act(const PartOrder& order) {
    System& system = watched_.system();
    Event& changed = watched_.changed();
    const TimePoint limit = place_.executive.now() + kOrderLimit;
    switch (order.kind) {
      case PartOrder::Kind::open_hardware:
        return system.open_hardware(changed, place_.executive.now() + kStartLimit);
      case PartOrder::Kind::configure:
        watched_.set_hang_limit(Duration{0});  // configure() has a limit of its own, as at a start
        return system.configure(order.component, changed, place_.executive.now() + kStartLimit);
      case PartOrder::Kind::open_gates:
        LastWords::catch_exit();
        system.open_gates();
        is_open_ = true;
        watch_hangs();
        return ok();
      case PartOrder::Kind::take_down: return take_down(order.keeps_states);
      case PartOrder::Kind::check_unused: return system.check_unused();
      case PartOrder::Kind::suspend: return system.suspend(order.component, changed, limit);
      case PartOrder::Kind::resume: return system.resume(order.component, changed, limit);
      case PartOrder::Kind::set_params:
        return system.set_params(order.component, order.params, changed, limit);
      case PartOrder::Kind::add:
        watched_.set_hang_limit(Duration{0});  // so has a constructor
        place_.catalogue.refresh();            // it may be of a plugin that was built since the start
        return changes_.add(*order.node, order.params);
      case PartOrder::Kind::remove: return remove(order.component);
      case PartOrder::Kind::open_gate: return changes_.open_gate(order.component);
      case PartOrder::Kind::rewire: return changes_.rewire(*order.connections, limit);
      case PartOrder::Kind::conclude: return conclude(order);
      case PartOrder::Kind::swap: break;  // is no matter of one step
    }
    return fail(Code::internal, "an unknown order");
  }

  Status conclude(const PartOrder& order) {
    const Result<ComponentInstance*> component = watched_.system().instance(order.component);
    if (!component) return component.error();
    (*component)->parts().peer_orders->conclude(order.outcome->first, order.outcome->second);
    return ok();
  }

  Status remove(const std::string& name) {
    const Status removed = changes_.remove(name, place_.executive.now() + kTakeDownLimit,
                                           [this](const ComponentInstance& last) { report_change(last); });
    if (removed.ok()) reported_.erase(name);
    return removed;
  }

  // Whatever the connections refuse from here on is no trouble.
  Status take_down(bool keeps_states) {
    is_open_ = false;
    watched_.set_hang_limit(Duration{0});  // it has its own limit
    watched_.reporter().ignore_trouble();
    place_.listener.counted(collect_counters(whole_, watched_.system()), sightings_.ways());
    const std::vector<std::string> stuck =
        watched_.system().take_down(place_.executive.now() + kTakeDownLimit, keeps_states);
    swaps_.give_up();
    taken_down_ = true;
    if (stuck.empty()) return ok();
    close_outputs();  // the process will be ended
    end_ = fail(Code::deadline_exceeded, listed(stuck) + (stuck.size() == 1 ? " does" : " do") + " not end");
    return end_;
  }

  void report_changes() {
    for (const auto& component : watched_.system().components().all()) report_change(*component);
    if (const bool rests = watched_.system().at_rest(); std::exchange(at_rest_, rests) != rests)
      place_.listener.rest_changed(rests);
  }

  void report_change(const ComponentInstance& component) {
    const ComponentReport report = component.report();
    const auto [known, is_new] = reported_.try_emplace(component.name(), report);
    if (is_new || known->second != report) {
      known->second = report;
      place_.listener.component_changed(component.name(), report);
    }
    while (const auto order = component.parts().peer_orders->take_order())
      place_.listener.peer_called({component.name(), order->first, order->second});
  }

  // A component hangs, and perhaps all others with it.
  void stand_still(const std::string& component, const std::string& text) {
    prepare_for_death();
    watched_.reporter().log(log::Level::error, component, text);
    RunResult result;
    result.outcome = RunOutcome::failed;
    result.culprit = component;
    result.error = fail(Code::deadline_exceeded, text, component);
    place_.listener.abandon(result);
  }

  const std::string process_;
  const graph::Graph part_;  // as it was built
  const PartPlace place_;
  graph::Graph whole_;  // its components and edges change on the main task, with graph_mutex_ held
  Mutex graph_mutex_;   // held by other threads that read them, or use ports
  const Duration hang_limit_;
  const RunOutputs outputs_;
  RunFiles files_;
  Sightings sightings_;
  OuterPorts ports_;  // the system's ports answer to it
  OuterEdges outer_;
  OrderBox orders_{[this] { watched_.changed().notify(); }};
  WatchedSystem watched_;
  Swaps swaps_;
  PartChanges changes_{process_, {whole_, graph_mutex_}, place_.catalogue, watched_, outer_, ports_.offers(),
                       swaps_};
  bool is_open_ = false;  // its components may work
  bool taken_down_ = false;
  Status end_;  // what has become of that
  std::map<std::string, ComponentReport> reported_;
  bool at_rest_ = true;
};

HostedPart::HostedPart(const graph::Graph& whole, const std::string& process, const PartPlace& place,
                       const PartOptions& options)
    : inside_(std::make_unique<Inside>(whole, process, place, options)) {}

HostedPart::~HostedPart() = default;

Status HostedPart::build(std::map<std::string, Descriptor> memory) {
  return inside_->build(std::move(memory));
}

std::map<std::string, std::string> HostedPart::robots() const { return inside_->watched().system().robots(); }

void HostedPart::run() { inside_->run(); }

void HostedPart::write_outputs() { inside_->write_outputs(); }

void HostedPart::prepare_for_death() { inside_->prepare_for_death(); }

RunGlance HostedPart::look() const { return inside_->look(); }

void HostedPart::order(PartOrder order) { inside_->order(std::move(order)); }

void HostedPart::stop_motors() { inside_->watched().stop_motors(); }

void HostedPart::hold(const std::string& reason) {
  (void)inside_->watched().system().hold(reason, Movers::all);
}

bool HostedPart::hold_devices(const std::string& reason) {
  return inside_->watched().system().hold(reason, Movers::on_lines);
}

bool HostedPart::let_go() { return inside_->watched().system().let_go(); }

RunCounters HostedPart::counters() const { return inside_->counters(); }

Result<std::shared_ptr<PortTap>> HostedPart::tap(const std::vector<graph::PortRef>& ports,
                                                 const PortTap::Bounds& bounds) {
  return inside_->tap(ports, bounds);
}

Status HostedPart::offer(const graph::PortRef& port, ObjectLoan object,
                         std::function<void(Result<ObjectRef>)> answered) {
  return inside_->offer(port, std::move(object), std::move(answered));
}

void HostedPart::hear(const idl::Alarm& alarm, const std::string& process) {
  inside_->watched().reporter().alarm_news().add(alarm, process);
}

void HostedPart::forget_alarm(const std::string& kind, const std::string& source,
                              const std::string& process) {
  inside_->watched().reporter().alarm_news().acknowledge(kind, source, process);
}

void PartAccess::open_descriptors(const std::function<void()>& open) {
  const struct Opening {
    Opening() { Environment::of_process().begin_own_opening(); }
    ~Opening() { Environment::of_process().end_own_opening(); }
  } opening;
  open();
}

void HostedPart::cut_edge(const std::string& edge, const Error& reason) {
  inside_->outer().cut(edge, reason);
}

Status HostedPart::renew_edge(const std::string& edge, const Descriptor& memory) {
  return inside_->outer().renew(edge, memory);
}

Status HostedPart::move_edge(const std::string& edge) { return inside_->move(edge); }

}  // namespace orca::host
