// SPDX-License-Identifier: LGPL-3.0-or-later
#include "crew.hpp"

#include <poll.h>

#include <algorithm>
#include <utility>

#include "making/worker.hpp"

namespace orca::batch {
namespace {

constexpr auto kTick = std::chrono::milliseconds(200);
constexpr const char* kNoProcessor = "it waited longer for a processor than the limit allows it to run";
constexpr const char* kKilled = "somebody killed its process, as a machine without free memory does";

}  // namespace

Result<bool> Crew::make(const Next& next, const Take& take) {
  for (;;) {
    if (Status started = start_some(next); !started.ok()) return started.error();
    if (running_.empty()) return true;
    if (wait()) return false;
    if (Status taken = take_finished(take); !taken.ok()) return taken.error();
    listener_.tick(running_.size());
  }
}

// An overloaded machine is better asked again later, so new runs go first.
std::optional<Task> Crew::take_next(const Next& next) {
  if (std::optional<Task> task = next()) return task;
  if (again_.empty()) return std::nullopt;
  const Task task = again_.front();
  again_.pop_front();
  return task;
}

Status Crew::start_some(const Next& next) {
  while (running_.size() < std::max<std::size_t>(options_.jobs, 1)) {
    const std::optional<Task> task = take_next(next);
    if (!task) break;
    Result<RunProcess> process = RunProcess::start(
        [&](int to) {
          if (task->elsewhere && !options_.alone.empty())
            work_elsewhere(experiment_, task->number, options_, {.to = to});
          work(experiment_, experiment_.run(task->number), options_,
               {.to = to, .elsewhere = task->elsewhere});
        },
        to_seconds(experiment_.limit));
    if (!process) return process.error();
    running_.push_back({*task, std::move(process).value()});
  }
  return ok();
}

// Waits for news of a run. Returns whether a stop was requested.
bool Crew::wait() {
  std::vector<pollfd> news{{requests_.descriptor(), POLLIN, 0}};
  for (const Running& one : running_) news.push_back({one.process.descriptor(), POLLIN, 0});
  (void)poll(news.data(), news.size(), kTick.count());
  for (std::size_t i = 0; i < running_.size(); ++i)
    if (news[i + 1].revents != 0) running_[i].has_ended = running_[i].process.read();
  return news[0].revents != 0;
}

Status Crew::take_finished(const Take& take) {
  for (auto one = running_.begin(); one != running_.end();) {
    const auto lateness = one->has_ended ? RunProcess::Lateness::none : one->process.lateness();
    if (!one->has_ended && lateness == RunProcess::Lateness::none) {
      ++one;
      continue;
    }
    if (Status taken = conclude(*one, lateness, take); !taken.ok()) return taken;
    one = running_.erase(one);
  }
  return ok();
}

Status Crew::conclude(Running& one, RunProcess::Lateness lateness, const Take& take) {
  Cost cost;
  if (one.has_ended) {
    const Outcome outcome = one.process.outcome(cost);
    const bool is_last = one.task.tries + 1 == kMostTries;  // whatever it dies of each time is its own fault
    if (!one.process.was_killed() || is_last) return take(one.task, outcome, cost);
    lose(one.task, kKilled);
    return ok();
  }
  one.process.kill_late(cost);
  if (lateness == RunProcess::Lateness::hang)
    return take(one.task,
                {.ending = Ending::hang,
                 .reason = "it did not end within the limit of the experiment",
                 .failure = Failure::crash},
                cost);
  lose(one.task, kNoProcessor);
  return ok();
}

void Crew::lose(Task task, const char* why) {
  const bool goes_on = ++task.tries < kMostTries;
  listener_.overloaded(task.number, why, goes_on);
  if (goes_on) {
    again_.push_back(task);
  } else {
    ++left_out_;
  }
}

}  // namespace orca::batch
