// SPDX-License-Identifier: LGPL-3.0-or-later
#include "task_run.hpp"

#include <algorithm>
#include <cstdio>
#include <utility>

namespace orca::tasks {
namespace {

constexpr double kObeyTime = 15.0;  // [s] for another component

// Returns whether a step changes something of another component, and changes it back.
bool changes_others(Kind kind) { return kind == Kind::with || kind == Kind::suspend; }

bool is_action(Kind kind) { return kind == Kind::drive || kind == Kind::ask; }

std::string seconds(double time) {
  char text[32];
  std::snprintf(text, sizeof text, "%g s", time);
  return text;
}

// Returns what kind of failure a reason is: "blocked: no nearer ..." is "blocked".
std::string kind_of_failure(const std::string& reason) { return reason.substr(0, reason.find(':')); }

// Adds the leaves at which a step is. Those of what a handler has interrupted are not among them; an action that waits for the end
// of a pause is.
void collect(const Task& task, const std::vector<TaskRun::Memory>& memories, std::size_t step,
             std::vector<std::size_t>& steps) {
  const TaskRun::Memory& memory = memories[step];
  const Step& s = task.steps[step];
  const bool runs = memory.state == TaskRun::State::running;
  if (s.children.empty()) {
    if (runs || (is_action(s.kind) && memory.state == TaskRun::State::idle)) steps.push_back(step);
  } else if (runs && s.kind == Kind::parallel) {
    for (const std::size_t child : s.children) collect(task, memories, child, steps);
  } else if (runs && memory.at < s.children.size()) {
    collect(task, memories, s.children[memory.at], steps);
  }
}

// Returns the handler that catches a failure of the attempt; 0: none.
std::size_t catcher(const Task& task, const std::vector<TaskRun::Memory>& memories, std::size_t attempt,
                    const std::string& reason) {
  const auto& children = task.steps[attempt].children;
  for (std::size_t i = 1; i < children.size(); ++i) {
    const Step& handler = task.steps.at(children[i]);
    if (handler.kind != Kind::caught || memories[children[i]].count >= handler.count) continue;
    if (handler.words.empty() || handler.words == kind_of_failure(reason)) return i;
  }
  return 0;
}

// Makes a step and all below it as if they had never begun.
void reset(const Task& task, std::vector<TaskRun::Memory>& memories, std::size_t step) {
  memories[step] = {};
  for (const std::size_t child : task.steps[step].children) reset(task, memories, child);
}

// Makes what has failed ready to go on there, and what was interrupted too.
void revive(const Task& task, std::vector<TaskRun::Memory>& memories, std::size_t step) {
  TaskRun::Memory& memory = memories[step];
  if (memory.state != TaskRun::State::failed) return;
  const Step& failed = task.steps[step];
  if (failed.kind != Kind::sequence && failed.kind != Kind::repeat) return reset(task, memories, step);
  memory.state = TaskRun::State::running;
  memory.reason.clear();
  for (const std::size_t child : failed.children) revive(task, memories, child);
}

}  // namespace

void TaskRun::tick(Actor& actor, double time) {
  actor_ = &actor;
  time_ = time;
  run(0);
}

void TaskRun::halt(Actor& actor) {
  actor_ = &actor;
  pause(0);
}

std::optional<std::size_t> TaskRun::skip(Actor& actor) {
  actor_ = &actor;
  const std::vector<std::size_t> steps = active();
  if (steps.empty()) return std::nullopt;
  pause(steps.back());
  memory_[steps.back()].state = State::done;
  return steps.back();
}

void TaskRun::end(Actor& actor, const std::string& reason) {
  actor_ = &actor;
  pause(0);
  fail(0, reason);
}

std::vector<std::size_t> TaskRun::active() const {
  std::vector<std::size_t> steps;
  collect(task_, memory_, 0, steps);
  return steps;
}

void TaskRun::delay(double time) {
  for (Memory& memory : memory_) memory.since += time;
}

void TaskRun::go_on_from(std::vector<Memory> memories, std::string last_failure) {
  memory_ = std::move(memories);
  last_failure_ = std::move(last_failure);
  for (std::size_t i = 0; i < memory_.size(); ++i)
    if (is_action(step_of(i).kind) && memory_[i].state == State::running) memory_[i].state = State::idle;
  // After the loss of a process the parameter may be as in the graph again, and the component go on.
  for (std::size_t i = 0; i < memory_.size(); ++i)
    if (changes_others(step_of(i).kind)) memory_[i].known = false;
}

TaskRun::State TaskRun::run(std::size_t step) {
  Memory& memory = memory_[step];
  if (memory.state == State::done || memory.state == State::failed) return memory.state;
  if (is_action(step_of(step).kind)) return run_action(step);
  if (memory.state == State::idle) memory = {.state = State::running, .since = time_, .known = memory.known};
  if (changes_others(step_of(step).kind)) return memory.state = run_with(step);
  switch (step_of(step).kind) {
    case Kind::fallback: return memory.state = run_fallback(step);
    case Kind::parallel: return memory.state = run_parallel(step);
    case Kind::repeat: return memory.state = run_repeat(step);
    case Kind::retry: return memory.state = run_retry(step);
    case Kind::timeout: return memory.state = run_timeout(step);
    case Kind::attempt: return memory.state = run_attempt(step);
    case Kind::sequence: return memory.state = run_sequence(step);
    case Kind::on:
    case Kind::caught: return memory.state = run_wrapped(step);
    default: return run_leaf(step);
  }
}

TaskRun::State TaskRun::run_wrapped(std::size_t step) {
  const std::size_t child = step_of(step).children[0];
  const State state = run(child);
  return state == State::failed ? fail(step, memory_[child].reason) : state;
}

TaskRun::State TaskRun::run_sequence(std::size_t step) {
  const auto& children = step_of(step).children;
  for (std::uint32_t& at = memory_[step].at; at < children.size(); ++at) {
    const State state = run(children[at]);
    if (state == State::failed) return fail(step, memory_[children[at]].reason);
    if (state == State::running) return state;
  }
  return State::done;
}

TaskRun::State TaskRun::run_fallback(std::size_t step) {
  const auto& children = step_of(step).children;
  for (std::uint32_t& at = memory_[step].at; at < children.size(); ++at) {
    const State state = run(children[at]);
    if (state != State::failed) return state;
  }
  return fail(step, memory_[children.back()].reason);
}

TaskRun::State TaskRun::run_parallel(std::size_t step) {
  const auto& children = step_of(step).children;
  const std::size_t need = step_of(step).count == 0 ? children.size() : step_of(step).count;
  std::size_t done = 0;
  std::size_t failed = 0;
  for (const std::size_t child : children) {
    const State state = run(child);
    if (state == State::done) ++done;
    if (state == State::failed) ++failed;
  }
  const bool is_done = done >= need;
  if (!is_done && children.size() - failed >= need) return State::running;
  for (const std::size_t child : children) pause(child);
  if (is_done) return State::done;
  const auto culprit = std::ranges::find_if(
      children, [this](std::size_t child) { return memory_[child].state == State::failed; });
  return fail(step, memory_[*culprit].reason);
}

// One round a tick at most, so that a round that takes no time is no endless loop.
TaskRun::State TaskRun::run_repeat(std::size_t step) {
  const Step& repeat = step_of(step);
  const std::size_t child = repeat.children[0];
  const State state = run(child);
  if (state == State::failed) return fail(step, memory_[child].reason);
  if (state == State::running) return state;
  ++memory_[step].count;
  if (repeat.count > 0 && memory_[step].count >= repeat.count) return State::done;
  if (repeat.time > 0.0 && time_ - memory_[step].since >= repeat.time) return State::done;
  reset(task_, memory_, child);
  return State::running;
}

TaskRun::State TaskRun::run_retry(std::size_t step) {
  const std::size_t child = step_of(step).children[0];
  const State state = run(child);
  if (state != State::failed) return state;
  if (++memory_[step].count >= step_of(step).count) return fail(step, memory_[child].reason);
  reset(task_, memory_, child);
  return State::running;
}

TaskRun::State TaskRun::run_timeout(std::size_t step) {
  const std::size_t child = step_of(step).children[0];
  const State state = run(child);
  if (state == State::failed) return fail(step, memory_[child].reason);
  if (state == State::done || time_ - memory_[step].since < step_of(step).time) return state;
  pause(child);
  return fail(step, "timed out: not done within " + seconds(step_of(step).time));
}

TaskRun::State TaskRun::run_with(std::size_t step) {
  const Step& with = step_of(step);
  Memory& memory = memory_[step];
  if (!memory.known) {
    if (memory.order == 0) memory.order = actor_->setter().order(with);
    const std::optional<Ending> ending = actor_->setter().outcome(memory.order);
    if (!ending && time_ - memory.since < kObeyTime) return State::running;
    if (!ending) {
      set_back(step);
      return fail(step, "timed out: nobody has " +
                            (with.kind == Kind::with ? "set " + with.param : "suspended " + with.component));
    }
    memory.order = 0;
    if (!ending->done) return fail(step, "refused: " + ending->reason);
    memory.known = true;
    if (memory.before.empty()) memory.before = ending->reason;
  }
  const State state = run_wrapped(step);
  if (state != State::running) set_back(step);
  return state;
}

// A change of a step is undone, also if it is only about to change.
void TaskRun::set_back(std::size_t step) {
  Memory& memory = memory_[step];
  if (memory.known || memory.order != 0)
    actor_->setter().set_back(step_of(step), memory.order, memory.before);
  memory.known = false;
  memory.order = 0;
  memory.before.clear();
}

// at: 0 while it is tried, else the handler that is on.
TaskRun::State TaskRun::run_attempt(std::size_t step) {
  const auto& children = step_of(step).children;
  if (const std::size_t handler = watch(step); handler != 0) {
    pause(children[memory_[step].at]);
    Memory& interrupted = memory_[children[memory_[step].at]];
    if (memory_[step].at != 0) interrupted.known = false;                               // it is seen again,
    if (step_of(children[memory_[step].at]).kind == Kind::caught) --interrupted.count;  // or caught again
    memory_[step].at = static_cast<std::uint32_t>(handler);
    reset(task_, memory_, children[handler]);
    memory_[children[handler]].known = true;
  }
  if (memory_[step].at != 0) return run_handler(step);
  const State state = run(children[0]);
  if (state != State::failed) return state;
  const std::string reason = memory_[children[0]].reason;
  const std::size_t handler = catcher(task_, memory_, step, reason);
  if (handler == 0) return fail(step, reason);
  const std::uint32_t caught = memory_[children[handler]].count + 1;
  reset(task_, memory_, children[handler]);
  memory_[children[handler]].count = caught;
  memory_[step].at = static_cast<std::uint32_t>(handler);
  return State::running;
}

// Returns the watching handler whose turn it is now; 0: none. One that stands before the one that is on interrupts it.
std::size_t TaskRun::watch(std::size_t attempt) {
  const auto& children = step_of(attempt).children;
  const std::size_t at = memory_[attempt].at;
  std::size_t found = 0;
  for (std::size_t i = children.size(); i-- > 1;) {
    const Step& handler = step_of(children[i]);
    if (handler.kind != Kind::on || i == at) continue;
    bool& known = memory_[children[i]].known;
    const bool holds = actor_->holds(*handler.condition);
    known = known && holds;
    if (holds && !known && (at == 0 || i < at)) found = i;
  }
  return found;
}

TaskRun::State TaskRun::run_handler(std::size_t attempt) {
  const std::size_t handler = step_of(attempt).children[memory_[attempt].at];
  const std::uint32_t caught = memory_[handler].count;
  const State state = run(handler);
  memory_[handler].count = caught;
  if (state == State::running) return state;
  if (state == State::failed) return fail(attempt, memory_[handler].reason);
  return handled(attempt, handler);
}

TaskRun::State TaskRun::handled(std::size_t attempt, std::size_t handler) {
  const Step& step = step_of(handler);
  const std::size_t tried = step_of(attempt).children[0];
  memory_[attempt].at = 0;
  switch (step.then) {
    case Then::resume:
      if (step.kind == Kind::caught) revive(task_, memory_, tried);  // what else has failed is caught again
      return State::running;
    case Then::again: reset(task_, memory_, tried); return State::running;
    case Then::done: return State::done;
    case Then::fail: break;
  }
  return fail(attempt, step.condition ? "interrupted: " + step.condition->text : memory_[tried].reason);
}

TaskRun::State TaskRun::run_leaf(std::size_t step) {
  Memory& memory = memory_[step];
  const Step& leaf = step_of(step);
  const bool is_over = time_ - memory.since >= leaf.time;
  if (leaf.kind == Kind::say) actor_->say(leaf.words);
  if (leaf.kind != Kind::check) return memory.state = is_over ? State::done : State::running;
  if (actor_->holds(*leaf.condition)) return memory.state = State::done;
  return is_over ? fail(step, "unmet: " + leaf.condition->text) : memory.state = State::running;
}

TaskRun::State TaskRun::run_action(std::size_t step) {
  const bool is_new = memory_[step].state != State::running;
  if (is_new) memory_[step] = {.state = State::running, .since = time_};
  const std::optional<Actor::Ending> ending =
      is_new ? actor_->begin(step_of(step)) : actor_->go_on(step_of(step));
  if (!ending) return State::running;
  return ending->done ? memory_[step].state = State::done : fail(step, ending->reason);
}

TaskRun::State TaskRun::fail(std::size_t step, std::string reason) {
  memory_[step].state = State::failed;
  last_failure_ = reason;
  memory_[step].reason = std::move(reason);
  return State::failed;
}

// Gives up the actions on the way below a step. They begin again when it goes on.
void TaskRun::pause(std::size_t step) {
  Memory& memory = memory_[step];
  if (memory.state != State::running) return;
  if (is_action(step_of(step).kind)) {
    actor_->halt(step_of(step));
    memory.state = State::idle;
  }
  for (const std::size_t child : step_of(step).children) pause(child);
  if (changes_others(step_of(step).kind)) set_back(step);
}

}  // namespace orca::tasks
