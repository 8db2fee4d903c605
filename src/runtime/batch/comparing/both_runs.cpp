// SPDX-License-Identifier: LGPL-3.0-or-later
#include <fcntl.h>
#include <poll.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <chrono>
#include <cstring>
#include <functional>
#include <optional>
#include <string>
#include <utility>

#include "making/process.hpp"
#include "making/worker.hpp"
#include "orca/base/descriptor.hpp"
#include "orca/batch/difference.hpp"

namespace orca::batch {
namespace {

constexpr auto kLook = std::chrono::milliseconds(200);

// A run in a process of its own whose deliveries can be read while it goes on. It waits while nobody reads.
//
// Thread contract: as RunProcess.
class TracedRun {
 public:
  // @param elsewhere  in other circumstances.
  // @errors  unavailable if no process can be started.
  static Result<TracedRun> start(const RunAgain& run, bool elsewhere);

  // Reads the next delivery; nothing if there are no more.
  // @errors  failed_precondition if `give_up` said so; deadline_exceeded if the run hangs.
  Result<std::optional<Delivery>> next(const std::function<bool()>& give_up);

  // Returns its outcome. @pre  next() has returned nothing.
  [[nodiscard]] Outcome outcome();

 private:
  TracedRun(RunProcess process, Descriptor trace) : process_(std::move(process)), trace_(std::move(trace)) {}

  [[nodiscard]] std::optional<std::string> take_line();
  void read_more();
  [[nodiscard]] Status wait(const std::function<bool()>& give_up);

  RunProcess process_;
  Descriptor trace_;
  std::string text_;       // of the trace, from begin_ on not handed out yet
  std::size_t begin_ = 0;  // of the next line in text_
  bool trace_ended_ = false;
  bool has_ended_ = false;
};

Result<TracedRun> TracedRun::start(const RunAgain& run, bool elsewhere) {
  std::array<int, 2> ends{};
  if (pipe2(ends.data(), O_CLOEXEC) != 0)
    return fail(Code::unavailable, std::string("there is no pipe for a trace: ") + std::strerror(errno));
  Descriptor from(ends[0]);
  const Descriptor to(ends[1]);
  const bool by_program = elsewhere && !run.options.alone.empty();
  Result<RunProcess> process = RunProcess::start(
      [&](int outcome) {
        const WorkPlan plan{.to = outcome, .trace = to.number(), .elsewhere = elsewhere};
        if (by_program) work_elsewhere(run.experiment, run.number, run.options, plan);
        work(run.experiment, run.experiment.run(run.number), run.options, plan);
      },
      to_seconds(run.experiment.limit));
  if (!process) return process.error();
  return TracedRun(std::move(process).value(), std::move(from));
}

Result<std::optional<Delivery>> TracedRun::next(const std::function<bool()>& give_up) {
  for (;;) {
    while (const std::optional<std::string> line = take_line())
      if (std::optional<Delivery> delivery = read_delivery(*line)) return delivery;
    if (trace_ended_ && has_ended_) return std::optional<Delivery>();
    if (Status waited = wait(give_up); !waited.ok()) return waited.error();
  }
}

std::optional<std::string> TracedRun::take_line() {
  const std::size_t end = text_.find('\n', begin_);
  if (end == std::string::npos) return std::nullopt;
  std::string line = text_.substr(begin_, end - begin_);
  begin_ = end + 1;
  return line;
}

void TracedRun::read_more() {
  text_.erase(0, begin_);
  begin_ = 0;
  std::array<char, 65536> bytes{};
  const ssize_t count = ::read(trace_.number(), bytes.data(), bytes.size());
  if (count > 0) text_.append(bytes.data(), static_cast<std::size_t>(count));
  trace_ended_ = count == 0 || (count < 0 && errno != EINTR && errno != EAGAIN);
}

// Both pipes are read, so that the process never waits for one that nobody looks at.
Status TracedRun::wait(const std::function<bool()>& give_up) {
  std::array<pollfd, 2> news{{{trace_ended_ ? -1 : trace_.number(), POLLIN, 0},
                              {has_ended_ ? -1 : process_.descriptor(), POLLIN, 0}}};
  const int count = poll(news.data(), news.size(), kLook.count());
  if (news[0].revents != 0) read_more();
  if (news[1].revents != 0) has_ended_ = process_.read();
  if (give_up()) return fail(Code::failed_precondition, "stopped");
  if (count == 0 && process_.lateness() != RunProcess::Lateness::none)
    return fail(Code::deadline_exceeded, "a run does not end");
  return ok();
}

Outcome TracedRun::outcome() {
  Cost unused;
  return process_.outcome(unused);
}

}  // namespace

Result<PairOfRuns> make_both(const RunAgain& first, const RunAgain& second,
                             const std::function<bool()>& give_up) {
  Result<TracedRun> one = TracedRun::start(first, false);
  if (!one) return one.error();
  Result<TracedRun> other = TracedRun::start(second, true);
  if (!other) return other.error();
  for (std::size_t number = 1;; ++number) {
    Result<std::optional<Delivery>> a = one->next(give_up);
    if (!a) return a.error();
    Result<std::optional<Delivery>> b = other->next(give_up);
    if (!b) return b.error();
    if (*a != *b) return PairOfRuns{DeliveryDifference{number, *std::move(a), *std::move(b)}};
    if (!*a) return PairOfRuns{std::nullopt, one->outcome().trace_hash, other->outcome().trace_hash};
  }
}

}  // namespace orca::batch
