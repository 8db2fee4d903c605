// SPDX-License-Identifier: LGPL-3.0-or-later
#include "orca/supervisor/restart_policy.hpp"

#include <algorithm>

namespace orca::supervisor {
namespace {

constexpr Duration kFirstDelay = 50ms;
constexpr Duration kLongestDelay = 2s;

}  // namespace

RestartPolicy::RestartPolicy(const std::vector<graph::ProcessNode>& processes,
                             const graph::Supervision& rules)
    : rules_(rules) {
  for (const graph::ProcessNode& process : processes)
    processes_.push_back({.name = process.name,
                          .rule = process.restart,
                          .on_demand = process.on_demand,
                          .state = process.on_demand ? State::asleep : State::running});
}

RestartDecision RestartPolicy::ended(std::size_t process, bool is_normal, Moment now, bool counts) {
  Process& one = processes_.at(process);
  if (one.state == State::ending) one.state = to_start_again(one);
  if (one.state == State::dozing) one.state = State::asleep;
  if (one.state == State::leaving) one.state = State::finished;
  if (one.state != State::running) return {};
  one.state = State::finished;
  if (!is_restarted(one, is_normal)) return {};
  if (counts && are_too_many(now)) return give_up();
  return restart_from(process, now + delay_after_fault(one, now));
}

bool RestartPolicy::is_restarted(const Process& process, bool is_normal) const {
  switch (process.rule) {
    case graph::Restart::permanent: return true;
    case graph::Restart::transient: return !is_normal;
    case graph::Restart::temporary: return false;
  }
  return false;
}

bool RestartPolicy::are_too_many(Moment now) {
  std::erase_if(restarts_, [&](Moment restart) { return now - restart >= rules_.within; });
  restarts_.push_back(now);
  return restarts_.size() > static_cast<std::size_t>(std::max(rules_.restarts, 0));
}

Duration RestartPolicy::delay_after_fault(Process& process, Moment now) const {
  if (process.faults > 0 && now - process.last_fault >= rules_.within) process.faults = 0;
  process.last_fault = now;
  if (process.faults++ == 0) return Duration{0};
  Duration delay = kFirstDelay;
  for (std::size_t i = 2; i < process.faults && delay < kLongestDelay; ++i) delay *= 2;
  return std::min(delay, kLongestDelay);
}

std::size_t RestartPolicy::first_concerned(std::size_t process) const {
  return rules_.strategy == graph::Strategy::one_for_all ? 0 : process;
}

std::size_t RestartPolicy::end_of_concerned(std::size_t process) const {
  return rules_.strategy == graph::Strategy::one_for_one ? process + 1 : processes_.size();
}

RestartDecision RestartPolicy::restart_from(std::size_t process, Moment start_at) {
  RestartDecision decision{.restarts = true, .gives_up = false, .end = {}};
  processes_[process].state = to_start_again(processes_[process]);
  for (std::size_t i = end_of_concerned(process); i-- > first_concerned(process);) {
    Process& one = processes_[i];
    one.start_at = std::max(one.start_at, start_at);
    if (one.state != State::running) continue;
    one.state = one.rule == graph::Restart::temporary ? State::leaving : State::ending;
    decision.end.push_back(i);
  }
  return decision;
}

RestartDecision RestartPolicy::give_up() {
  RestartDecision decision{.restarts = false, .gives_up = true, .end = {}};
  for (std::size_t i = processes_.size(); i-- > 0;) {
    State& state = processes_[i].state;
    if (state == State::running) decision.end.push_back(i);
    const bool lives = state == State::running || state == State::ending || state == State::leaving ||
                       state == State::dozing;
    state = lives ? State::leaving : State::finished;
  }
  return decision;
}

void RestartPolicy::put_to_sleep(std::size_t process) {
  Process& one = processes_[process];
  if (one.state == State::running) one.state = State::dozing;
}

void RestartPolicy::retire(std::size_t process) {
  State& state = processes_[process].state;
  const bool is_gone = state == State::waiting || state == State::asleep || state == State::finished;
  state = is_gone ? State::finished : State::leaving;
}

void RestartPolicy::go_over(const std::vector<graph::ProcessNode>& processes) {
  std::vector<Process> all;
  for (const graph::ProcessNode& node : processes) {
    const auto known = std::ranges::find(processes_, node.name, &Process::name);
    all.push_back(known == processes_.end() ? Process{.name = node.name, .state = State::finished}
                                            : std::move(*known));
    all.back().rule = node.restart;
    all.back().on_demand = node.on_demand;
  }
  processes_ = std::move(all);
}

bool RestartPolicy::awaits_end() const {
  return std::ranges::any_of(processes_, [](const Process& process) {
    return process.state == State::ending || process.state == State::leaving;
  });
}

void RestartPolicy::restart(std::size_t process, Moment now) {
  Process& one = processes_[process];
  const bool is_gone =
      one.state == State::waiting || one.state == State::asleep || one.state == State::finished;
  one.state = is_gone ? to_start_again(one) : State::ending;
  one.start_at = now;
}

std::vector<std::size_t> RestartPolicy::take_due(Moment now, const IsNeeded& is_needed) {
  std::vector<std::size_t> due;
  if (awaits_end()) return due;
  for (std::size_t i = 0; i < processes_.size(); ++i) {
    Process& one = processes_[i];
    const bool is_to_start =
        one.state == State::waiting || (one.state == State::asleep && is_needed && is_needed(i));
    if (!is_to_start || one.start_at > now) continue;
    one.state = State::running;
    due.push_back(i);
  }
  return due;
}

std::optional<Moment> RestartPolicy::due() const {
  std::optional<Moment> next;
  if (awaits_end()) return next;
  for (const Process& process : processes_)
    if (process.state == State::waiting) next = std::min(next.value_or(Moment::max()), process.start_at);
  return next;
}

}  // namespace orca::supervisor
