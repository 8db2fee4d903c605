// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <map>
#include <memory>
#include <random>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "machines/gathering.hpp"

namespace orca::test {

using supervisor::Gathering;
using supervisor::Moment;

inline constexpr Moment kStart{100s};
inline constexpr Duration kStep = 10ms;
inline constexpr Duration kRepeat = 200ms;
inline constexpr Duration kBuilding = 100ms;

using Words = std::vector<std::string>;

/// Three machines, and five components, each after the one before it.
inline graph::Graph chain(graph::OnLoss on_loss = graph::OnLoss::stop, Duration loss_limit = 1s) {
  graph::Graph graph;
  graph.name = "chain";
  for (const std::string name : {"base", "brain", "eye"}) {
    graph.machines.push_back({.name = name, .on_loss = on_loss, .loss_limit = loss_limit});
    graph.processes.push_back({.name = "on_" + name, .machine = name});
  }
  std::string before;
  for (const auto& [name, machine] : std::vector<std::pair<std::string, std::string>>{
           {"e", "eye"}, {"b", "base"}, {"a", "brain"}, {"d", "base"}, {"c", "eye"}}) {
    graph::ComponentNode node;
    node.name = name;
    node.process = "on_" + machine;
    if (!before.empty()) node.start_after = {before};
    graph.components.push_back(node);
    before = name;
  }
  graph.ends = {"a", "c"};
  return graph;
}

inline const Words kOrder{"e", "b", "a", "d", "c"};

/// A network that loses and delays what is said on it.
class Network {
 public:
  Network(unsigned seed, double loss, Duration delay) : random_(seed), loss_(loss), delay_(delay) {}

  void join(const std::string& machine) { machines_.insert(machine); }
  void part(const std::string& machine, bool apart) {
    parted_.erase(machine);
    if (apart) parted_.insert(machine);
  }

  void say(const std::string& from, const idl::MachineState& state, Moment now) {
    for (const std::string& to : machines_) {
      if (parted_.contains(from) != parted_.contains(to) || dice() < loss_) continue;
      const auto delay = std::chrono::duration_cast<Moment::duration>(delay_ * dice());
      under_way_.push_back({to, state, now + delay});
    }
  }

  void leave(const std::string& machine) {
    std::erase_if(under_way_, [&](const Letter& letter) { return letter.to == machine; });
  }

  // Returns what has come to a machine.
  std::vector<idl::MachineState> take(const std::string& machine, Moment now) {
    std::vector<idl::MachineState> come;
    std::erase_if(under_way_, [&](const Letter& letter) {
      if (letter.to != machine || letter.at > now) return false;
      come.push_back(letter.state);
      return true;
    });
    return come;
  }

 private:
  struct Letter {
    std::string to;
    idl::MachineState state;
    Moment at;
  };
  double dice() { return static_cast<double>(random_()) / std::mt19937::max(); }

  std::mt19937 random_;
  double loss_;
  Duration delay_;
  std::set<std::string> machines_, parted_;
  std::vector<Letter> under_way_;
};

/// A supervisor of which everything is left out but what it says to others.
class Machine {
 public:
  Machine(const graph::Graph& graph, std::string name, std::uint64_t run, Network& network, Words& configured)
      : gathering(graph, name, run), name_(std::move(name)), network_(network), configured_(configured) {
    for (const graph::ComponentNode& node : graph.components)
      if (node.process == "on_" + name_) left_.push_back(node.name);
    network_.join(name_);
  }

  void turn(Moment now) {
    for (const idl::MachineState& state : network_.take(name_, now)) gathering.hear(state, now);
    gathering.look(now);
    if (gathering.verdict()) gathering.end(gathering.verdict()->end, gathering.verdict()->why);
    advance(now);
    for (const Gathering::News& item : gathering.take_news()) news.push_back(item);
    publish(now);
  }

  idl::MachinePhase phase() const { return gathering.state().phase(); }
  bool told(const std::string& text) const {
    return std::ranges::any_of(
        news, [&](const Gathering::News& item) { return item.text.find(text) != std::string::npos; });
  }
  bool lost(const std::string& machine) const {
    return std::ranges::any_of(news, [&](const Gathering::News& item) {
      return item.kind == Gathering::News::Kind::lost && item.text.find(machine) != std::string::npos;
    });
  }
  // Returns whether the alarm about a machine was settled.
  bool is_back(const std::string& machine) const {
    return std::ranges::any_of(news, [&](const Gathering::News& item) {
      return item.kind == Gathering::News::Kind::back && item.machine == machine;
    });
  }

  Gathering gathering;
  std::vector<Gathering::News> news;
  Moment began{};

 private:
  void advance(Moment now) {
    switch (phase()) {
      case idl::MACHINE_GATHERING:
        if (gathering.missing().empty()) gathering.enter(idl::MACHINE_BUILDING), built_at_ = now + kBuilding;
        return;
      case idl::MACHINE_BUILDING:
        if (now >= built_at_) come_up(now);
        return;
      case idl::MACHINE_CONFIGURING:
      case idl::MACHINE_READY: return come_up(now);
      default: return;
    }
  }

  void come_up(Moment now) {
    if (left_.empty()) {
      if (gathering.may_begin()) gathering.enter(idl::MACHINE_WORKING), began = now;
    } else if (gathering.may_configure(left_.front())) {
      configured_.push_back(left_.front());
      left_.erase(left_.begin());
    }
  }

  void publish(Moment now) {
    idl::MachineState state = gathering.state();
    if (state == said_ && now < due_) return;
    said_ = state;
    due_ = now + kRepeat;
    state.seq(++seq_);
    network_.say(name_, state, now);
  }

  const std::string name_;
  Network& network_;
  Words& configured_;  // of all machines, in the order in which it happened
  Words left_;
  Moment built_at_{}, due_{};
  idl::MachineState said_;
  std::uint64_t seq_ = 0;
};

/// A system of machines, each of which may be started and killed at any time.
class System {
 public:
  explicit System(graph::Graph graph, unsigned seed = 1, double loss = 0.0, Duration delay = 0ms)
      : graph_(std::move(graph)), network(seed, loss, delay) {}

  Machine& start(const std::string& name) { return start(name, graph_); }
  Machine& start(const std::string& name, const graph::Graph& graph) {
    machines_[name] = std::make_unique<Machine>(graph, name, ++runs_, network, configured);
    return *machines_[name];
  }
  void start_all() {
    for (const std::string name : {"base", "brain", "eye"}) start(name);
  }
  void kill(const std::string& name) {
    machines_.erase(name);
    network.leave(name);
  }
  Machine& at(const std::string& name) { return *machines_.at(name); }

  void pass(Duration time) {
    for (const Moment end = now + time; now < end; now += kStep)
      for (const auto& [name, machine] : machines_) machine->turn(now);
  }
  template <class Condition>
  bool passes_until(const Condition& condition, Duration limit) {
    for (const Moment end = now + limit; now < end && !condition();) pass(kStep);
    return condition();
  }
  bool all_are(idl::MachinePhase phase) const {
    return std::ranges::all_of(machines_, [&](const auto& entry) { return entry.second->phase() == phase; });
  }
  bool all_work() const { return all_are(idl::MACHINE_WORKING); }

  Moment now = kStart;
  Words configured;

 private:
  const graph::Graph graph_;

 public:
  Network network;

 private:
  std::map<std::string, std::unique_ptr<Machine>> machines_;
  std::uint64_t runs_ = 0;
};

}  // namespace orca::test
