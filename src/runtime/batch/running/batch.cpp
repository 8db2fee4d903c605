// SPDX-License-Identifier: LGPL-3.0-or-later
#include "orca/batch/batch.hpp"

#include <poll.h>
#include <sys/signalfd.h>
#include <unistd.h>

#include <algorithm>
#include <csignal>
#include <utility>

#include "process.hpp"
#include "worker.hpp"

namespace orca::batch {
namespace {

constexpr auto kTick = std::chrono::milliseconds(200);

// Takes SIGINT and SIGTERM as news instead of an end, as long as it exists.
class StopRequests {
 public:
  StopRequests() {
    sigset_t wanted;
    sigemptyset(&wanted);
    sigaddset(&wanted, SIGINT);
    sigaddset(&wanted, SIGTERM);
    sigprocmask(SIG_BLOCK, &wanted, &before_);
    descriptor_ = signalfd(-1, &wanted, SFD_CLOEXEC | SFD_NONBLOCK);
  }
  ~StopRequests() {
    signalfd_siginfo taken{};
    while (::read(descriptor_, &taken, sizeof taken) > 0) continue;
    close(descriptor_);
    sigprocmask(SIG_SETMASK, &before_, nullptr);
  }
  StopRequests(const StopRequests&) = delete;
  StopRequests& operator=(const StopRequests&) = delete;
  [[nodiscard]] int descriptor() const { return descriptor_; }

 private:
  sigset_t before_{};
  int descriptor_ = -1;
};

class Batch {
 public:
  Batch(const Experiment& experiment, const std::vector<std::size_t>& wanted, const BatchOptions& options,
        BatchListener& listener)
      : experiment_(experiment), wanted_(wanted), options_(options), listener_(listener) {}

  Result<bool> run() {
    while (next_ < wanted_.size() || !processes_.empty()) {
      if (Status started = start_some(); !started.ok()) return started.error();
      if (wait()) return false;
      if (Status taken = take_finished(); !taken.ok()) return taken.error();
      listener_.tick(processes_.size());
    }
    return true;
  }

 private:
  Status start_some() {
    while (next_ < wanted_.size() && processes_.size() < std::max<std::size_t>(options_.jobs, 1)) {
      const std::size_t number = wanted_[next_];
      Result<RunProcess> process = RunProcess::start(
          number, [&](int to) { work(experiment_, experiment_.run(number), options_, to); },
          to_seconds(experiment_.limit));
      if (!process) return process.error();
      processes_.push_back({std::move(process).value(), false});
      ++next_;
    }
    return ok();
  }

  // Waits for news of a run. Returns whether a stop was requested.
  bool wait() {
    std::vector<pollfd> news{{requests_.descriptor(), POLLIN, 0}};
    for (const Running& one : processes_) news.push_back({one.process.descriptor(), POLLIN, 0});
    (void)poll(news.data(), news.size(), kTick.count());
    for (std::size_t i = 0; i < processes_.size(); ++i)
      if (news[i + 1].revents != 0) processes_[i].has_ended = processes_[i].process.read();
    return news[0].revents != 0;
  }

  Status take_finished() {
    const auto now = RunProcess::Clock::now();
    for (auto one = processes_.begin(); one != processes_.end();) {
      if (!one->has_ended && now < one->process.deadline()) {
        ++one;
        continue;
      }
      Cost cost;
      const Outcome outcome = one->has_ended ? one->process.outcome(cost) : one->process.kill_late(cost);
      if (Status stored = listener_.finished(one->process.run(), outcome, cost); !stored.ok()) return stored;
      one = processes_.erase(one);
    }
    return ok();
  }

  struct Running {
    RunProcess process;
    bool has_ended;
  };

  const Experiment& experiment_;
  const std::vector<std::size_t>& wanted_;
  const BatchOptions& options_;
  BatchListener& listener_;
  StopRequests requests_;
  std::vector<Running> processes_;
  std::size_t next_ = 0;  // of wanted_
};

}  // namespace

Result<bool> run_batch(const Experiment& experiment, const std::vector<std::size_t>& wanted,
                       const BatchOptions& options, BatchListener& listener) {
  return Batch(experiment, wanted, options, listener).run();
}

}  // namespace orca::batch
