// SPDX-License-Identifier: LGPL-3.0-or-later
#include "orca/batch/batch.hpp"

#include <map>
#include <set>

#include "crew.hpp"
#include "orca/batch/difference.hpp"
#include "stop_requests.hpp"

namespace orca::batch {
namespace {

// A run that depends on addresses may come out the same by chance.
constexpr int kMostPairs = 5;

// The runs that are made twice.
class RunsTwice {
 public:
  explicit RunsTwice(const std::vector<std::size_t>& numbers) {
    for (const std::size_t number : numbers)
      for (const bool elsewhere : {false, true}) tasks_.push_back({number, elsewhere});
  }

  std::optional<Task> next() {
    return next_ < tasks_.size() ? std::optional<Task>(tasks_[next_++]) : std::nullopt;
  }
  void take(const Task& task, const Outcome& outcome) {
    (task.elsewhere ? second_ : first_)[task.number] = outcome;
  }
  // Calls `compare` for each run that was made both times.
  Status for_each(const std::function<Status(std::size_t, const Outcome&, const Outcome&)>& compare) const {
    for (const auto& [number, first] : first_) {
      const auto second = second_.find(number);
      if (second == second_.end()) continue;
      if (Status compared = compare(number, first, second->second); !compared.ok()) return compared;
    }
    return ok();
  }

 private:
  std::vector<Task> tasks_;
  std::size_t next_ = 0;  // of tasks_
  std::map<std::size_t, Outcome> first_;
  std::map<std::size_t, Outcome> second_;
};

std::string mark_of(const Outcome& outcome) {
  return outcome.trace_hash.empty() ? name_of(outcome.ending) : outcome.trace_hash;
}

// Returns whether two outcomes are the same but for the words of the reason, which may name a process.
bool are_same(Outcome a, const Outcome& b) {
  a.reason = b.reason;
  return a == b;
}

class Batch {
 public:
  Batch(const Experiment& experiment, const BatchPlan& plan, const BatchOptions& options,
        BatchListener& listener)
      : experiment_(experiment), plan_(plan), options_(options), listener_(listener) {}

  Result<BatchEnd> run() {
    RunsTwice twice(plan_.twice);
    const Result<bool> began = crew_.make([&] { return twice.next(); },
                                          [&](const Task& task, const Outcome& outcome, const Cost& cost) {
                                            twice.take(task, outcome);
                                            return task.elsewhere ? ok() : finish(task, outcome, cost);
                                          });
    if (!began) return began.error();
    if (!*began) return BatchEnd::stopped;
    const Status compared =
        twice.for_each([this](std::size_t number, const Outcome& first, const Outcome& second) {
          const Repeat repeat = compared_runs(number, first, second);
          // A search that was stopped says nothing.
          return requests_.any() ? ok() : listener_.repeated(number, repeat);
        });
    if (!compared.ok()) return compared.error();
    return run_others();
  }

 private:
  Result<BatchEnd> run_others() {
    if (requests_.any()) return BatchEnd::stopped;
    const auto next = [this]() -> std::optional<Task> {
      const std::optional<std::size_t> number = plan_.next ? plan_.next() : std::nullopt;
      return number ? std::optional<Task>(Task{*number}) : std::nullopt;
    };
    const Result<bool> finished =
        crew_.make(next, [this](const Task& task, const Outcome& outcome, const Cost& cost) {
          return finish(task, outcome, cost);
        });
    if (!finished) return finished.error();
    if (!*finished) return BatchEnd::stopped;
    return crew_.left_out() == 0 ? BatchEnd::complete : BatchEnd::overloaded;
  }

  Status finish(const Task& task, const Outcome& outcome, const Cost& cost) {
    return listener_.finished(task.number, outcome, cost);
  }

  // The deliveries are looked at in one run of each variant only.
  Repeat compared_runs(std::size_t number, const Outcome& first, const Outcome& second) {
    Repeat repeat{mark_of(first), mark_of(second)};
    if (are_same(first, second)) return repeat;
    if (different_.contains(experiment_.run(number).variant)) {
      repeat.difference = "it differs as well";
      return repeat;
    }
    find_difference(number, first, second, repeat);
    if (!repeat.difference.empty()) different_.insert(experiment_.run(number).variant);
    return repeat;
  }

  // Makes the run twice more, with a look at the deliveries.
  void find_difference(std::size_t number, const Outcome& first, const Outcome& second, Repeat& repeat) {
    const RunAgain again{experiment_, number, options_};
    for (int i = 0; i < kMostPairs; ++i) {
      const Result<PairOfRuns> pair = make_both(again, again, [this] { return requests_.any(); });
      if (!pair) break;
      if (pair->difference) {
        repeat.difference = pair->difference->text("the first run", "the second");
        return;
      }
      // The second one did not start, for want of the machine, and does now.
      if (second.trace_hash.empty() && pair->second_hash == first.trace_hash) {
        repeat.second = pair->second_hash;
        return;
      }
    }
    repeat.difference = "it ended as " + std::string(name_of(first.ending)) + " and then as " +
                        name_of(second.ending) + "; while the deliveries were watched, they were the same";
  }

  const Experiment& experiment_;
  const BatchPlan& plan_;
  const BatchOptions& options_;
  BatchListener& listener_;
  std::set<std::size_t> different_;  // variants of which a run was different when it was made again
  StopRequests requests_;
  Crew crew_{experiment_, options_, listener_, requests_};
};

}  // namespace

Result<BatchEnd> run_batch(const Experiment& experiment, const BatchPlan& plan, const BatchOptions& options,
                           BatchListener& listener) {
  return Batch(experiment, plan, options, listener).run();
}

}  // namespace orca::batch
