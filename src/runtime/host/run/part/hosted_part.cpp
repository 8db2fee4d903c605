// SPDX-License-Identifier: LGPL-3.0-or-later
#include "orca/host/hosted_part.hpp"

#include <deque>
#include <exception>
#include <mutex>
#include <optional>
#include <utility>

#include "orca/base/exhaustion.hpp"
#include "orca/base/text.hpp"
#include "orca/graph/placement.hpp"
#include "orca/host/last_words.hpp"
#include "outer_edges.hpp"
#include "run/watched_system.hpp"

namespace orca::host {
namespace {

constexpr Duration kStartLimit = 10s;
constexpr Duration kOrderLimit = 5s;
constexpr Duration kTakeDownLimit = 1500ms;

SystemOptions system_options(const PartOptions& options) {
  return {options.seed, false, options.failures, options.log_name, options.missions, options.doorbell};
}

}  // namespace

class HostedPart::Inside {
 public:
  Inside(const graph::Graph& whole, const std::string& process, const PartPlace& place,
         const PartOptions& options)
      : part_(graph::subgraph(whole, process)),
        place_(place),
        hang_limit_(options.hang_limit),
        trace_(place.executive),
        outer_(whole, options.doorbell),
        watched_(part_, {place.catalogue, place.executive, trace_, place.listener}, system_options(options),
                 [] { return false; }) {}

  WatchedSystem& watched() { return watched_; }
  OuterEdges& outer() { return outer_; }

  Status build(std::map<std::size_t, Descriptor> memory) {
    if (Status known = outer_.prepare(std::move(memory), place_.catalogue); !known.ok()) return known;
    if (Status built = watched_.build(); !built.ok()) return built;
    return outer_.connect(watched_.system());
  }

  void run() {
    watched_.run([this] { obey(); }, [this](const std::string& component,
                                            const std::string& text) { stand_still(component, text); });
  }

  void order(PartOrder order) {
    {
      const std::lock_guard lock(mutex_);
      if (!closed_) {
        orders_.push_back(std::move(order));
        watched_.changed().notify();
        return;
      }
    }
    if (order.done) order.done(fail(Code::failed_precondition, "the process is being taken down"));
  }

 private:
  void obey() {
    while (!taken_down_) {
      report_changes();
      if (std::optional<PartOrder> order = next_order()) {
        carry_out(*order);
      } else {
        watched_.changed().wait_until(kForever);
      }
    }
    report_changes();
    refuse_the_rest();
  }

  std::optional<PartOrder> next_order() {
    const std::lock_guard lock(mutex_);
    if (orders_.empty()) return std::nullopt;
    PartOrder order = std::move(orders_.front());
    orders_.pop_front();
    return order;
  }

  void refuse_the_rest() {
    {
      const std::lock_guard lock(mutex_);
      closed_ = true;
    }
    while (const std::optional<PartOrder> order = next_order())
      if (order->done) order->done(fail(Code::failed_precondition, "the process is being taken down"));
  }

  void carry_out(const PartOrder& order) {
    const Status outcome = try_to_carry_out(order);
    report_changes();
    if (order.done) order.done(outcome);
  }

  Status try_to_carry_out(const PartOrder& order) {
    try {
      return act(order);
    } catch (...) {
      const char* const text = exhaustion_text(std::current_exception());
      if (text == nullptr) throw;
      return fail(Code::unavailable, text);
    }
  }

  Status act(const PartOrder& order) {
    System& system = watched_.system();
    Event& changed = watched_.changed();
    const TimePoint limit = place_.executive.now() + kOrderLimit;
    switch (order.kind) {
      case PartOrder::Kind::open_hardware:
        return system.open_hardware(changed, place_.executive.now() + kStartLimit);
      case PartOrder::Kind::configure:
        return system.configure(order.component, changed, place_.executive.now() + kStartLimit);
      case PartOrder::Kind::open_gates:
        LastWords::catch_exit();
        system.open_gates();
        watched_.set_hang_limit(hang_limit_);
        return ok();
      case PartOrder::Kind::take_down: return take_down();
      case PartOrder::Kind::suspend: return system.suspend(order.component, changed, limit);
      case PartOrder::Kind::resume: return system.resume(order.component, changed, limit);
      case PartOrder::Kind::set_params:
        return system.set_params(order.component, order.params, changed, limit);
    }
    return fail(Code::internal, "an unknown order");
  }

  // Whatever the connections refuse from here on is no trouble.
  Status take_down() {
    watched_.set_hang_limit(Duration{0});  // it has its own limit
    watched_.reporter().ignore_trouble();
    const std::vector<std::string> stuck =
        watched_.system().take_down(place_.executive.now() + kTakeDownLimit);
    taken_down_ = true;
    if (stuck.empty()) return ok();
    return fail(Code::deadline_exceeded, listed(stuck) + (stuck.size() == 1 ? " does" : " do") + " not end");
  }

  void report_changes() {
    for (const auto& component : watched_.system().components()) {
      const ComponentReport report = component->report();
      auto [known, is_new] = reported_.try_emplace(component->name(), report);
      if (!is_new && known->second == report) continue;
      known->second = report;
      place_.listener.component_changed(component->name(), report);
    }
    if (const bool rests = watched_.system().at_rest(); std::exchange(at_rest_, rests) != rests)
      place_.listener.rest_changed(rests);
  }

  // A component hangs, and perhaps all others with it.
  void stand_still(const std::string& component, const std::string& text) {
    watched_.stop_motors();
    watched_.reporter().log(log::Level::error, component, text);
    RunResult result;
    result.outcome = RunOutcome::failed;
    result.culprit = component;
    result.error = fail(Code::deadline_exceeded, text, component);
    place_.listener.abandon(result);
  }

  const graph::Graph part_;
  const PartPlace place_;
  const Duration hang_limit_;
  Trace trace_;
  OuterEdges outer_;
  WatchedSystem watched_;
  bool taken_down_ = false;
  std::map<std::string, ComponentReport> reported_;
  bool at_rest_ = true;

  std::mutex mutex_;
  // Below: guarded by mutex_.
  std::deque<PartOrder> orders_;
  bool closed_ = false;
};

HostedPart::HostedPart(const graph::Graph& whole, const std::string& process, const PartPlace& place,
                       const PartOptions& options)
    : inside_(std::make_unique<Inside>(whole, process, place, options)) {}

HostedPart::~HostedPart() = default;

Status HostedPart::build(std::map<std::size_t, Descriptor> memory) {
  return inside_->build(std::move(memory));
}

std::map<std::string, std::string> HostedPart::robots() const { return inside_->watched().system().robots(); }

void HostedPart::run() { inside_->run(); }

void HostedPart::order(PartOrder order) { inside_->order(std::move(order)); }

void HostedPart::stop_motors() { inside_->watched().stop_motors(); }

void HostedPart::cut_edge(std::size_t edge, const Error& reason) { inside_->outer().cut(edge, reason); }

Status HostedPart::renew_edge(std::size_t edge, const Descriptor& memory) {
  return inside_->outer().renew(edge, memory);
}

}  // namespace orca::host
