// SPDX-License-Identifier: GPL-3.0-or-later
// Additional permission: LICENSES/Orca-plugin-exception.txt
#include "steering.hpp"

#include <signal.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <utility>

#include "guest_objects.hpp"
#include "orca/base/text.hpp"
#include "orca/xml/number.hpp"

namespace orca::guest {
namespace {

// Looks come every 0.2 ms while time passes, so that no more than this waits.
constexpr host::PortTap::Bounds kBounds{.objects = 1'000'000, .bytes = 0};

Packet over() { return {"over"}; }

}  // namespace

Steering::Steering(Descriptor socket, std::vector<graph::PortRef> ports)
    : line_(std::move(socket)), ports_(std::move(ports)) {}

Steering::~Steering() { leave(); }

void Steering::enter(host::PartAccess& run) {
  run.open_descriptors([&] {
    const std::lock_guard lock(mutex_);
    run_ = &run;
    if (auto tap = run.tap(ports_, kBounds)) tap_ = std::move(tap).value();
    thread_ = std::jthread([this] { serve(); });
  });
}

void Steering::leave() {
  is_over_ = true;
  {
    const std::lock_guard lock(mutex_);
    if (run_ != nullptr) look();
    tap_.reset();
    run_ = nullptr;
  }
  if (!thread_.joinable()) return;
  line_.end_input();
  thread_.join();
}

void Steering::serve() {
  while (const std::optional<Packet> order = line_.receive()) line_.send(answer(*order));
  if (!is_over_) kill(getpid(), SIGTERM);
}

Packet Steering::answer(const Packet& order) {
  const auto at = [&](std::size_t index) { return index < order.size() ? order[index] : std::string(); };
  if (at(0) == "begin") return wait([this] { return is_up_.load(); }) ? Packet{"ok"} : over();
  if (at(0) == "step") return step(at(1));
  if (at(0) == "latest") return latest(at(1));
  if (at(0) == "set") return set(at(1), at(2), at(3));
  return {"error", "a run cannot be asked for " + in_quotes(at(0))};
}

template <class Condition>
bool Steering::wait(Condition condition) {
  while (!is_over_ && !condition()) {
    {
      const std::lock_guard lock(mutex_);
      look();
    }
    std::this_thread::sleep_for(std::chrono::microseconds(200));
  }
  const std::lock_guard lock(mutex_);
  look();
  return !is_over_;
}

Packet Steering::step(const std::string& nanoseconds) {
  const Result<std::int64_t> span = xml::parse_integer(nanoseconds);
  if (!span) return packet_of(span.error());
  const TimePoint end = saturating_add(pace_.look().time, Duration(*span));
  if (const Status begun = pace_.step(Duration(*span)); !begun.ok()) return packet_of(begun.error());
  (void)wait([this] { return !pace_.look().steps; });
  // A run that ends lets time pass until all is taken down. That is no part of a step, and a step up to the end is whole.
  const Pace::State come = pace_.look();
  const TimePoint until = come.finished.value_or(come.time);
  if (until < end) return over();
  return {"ok", std::to_string(until.time_since_epoch().count())};
}

Packet Steering::latest(const std::string& port) {
  const std::lock_guard lock(mutex_);
  look();
  if (std::ranges::find(ports_, port, &graph::PortRef::text) == ports_.end())
    return {"error",
            "no object leaves a component at " + in_quotes(port) + "; deployer --list-ports has all ports"};
  const auto found = latest_.find(port);
  return packet_of(found == latest_.end() ? ObjectRef() : found->second);
}

Packet Steering::set(const std::string& component, const std::string& param, const std::string& value) {
  std::atomic<bool> answered{false};
  Status outcome;
  {
    const std::lock_guard lock(mutex_);
    if (run_ == nullptr) return over();
    host::PartOrder order;
    order.kind = host::PartOrder::Kind::set_params;
    order.component = component;
    order.params = {{param, value}};
    order.done = [&](const Status& status) {
      outcome = status;
      answered = true;
    };
    run_->order(std::move(order));
  }
  while (!answered) std::this_thread::sleep_for(std::chrono::microseconds(200));
  return outcome.ok() ? Packet{"ok"} : packet_of(outcome.error());
}

void Steering::look() {
  if (tap_ == nullptr) return;
  for (host::PortTap::Passed& passed : tap_->take())
    latest_[ports_[passed.place].text()] = std::move(passed.object);
}

}  // namespace orca::guest
