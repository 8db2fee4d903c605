// SPDX-License-Identifier: LGPL-3.0-or-later
#include "members/conductor.hpp"

#include <pthread.h>

#include <atomic>
#include <exception>
#include <stdexcept>
#include <thread>
#include <utility>

namespace orca::supervisor {
namespace {

std::unique_ptr<Executive> make_one_task_at_a_time() {
#if defined(__SANITIZE_THREAD__)
  constexpr Backend kBackend = Backend::baton;  // the sanitizer does not know fibers
#else
  constexpr Backend kBackend = Backend::fiber;
#endif
  return std::move(make_executive({ClockKind::steady, kBackend})).value();
}

}  // namespace

// A job while it is under way. Whoever resumes it rests until the job waits again or ends.
struct Conductor::Job {
  std::function<void()> body;
  std::unique_ptr<Event> turn;
  Event* resumer = nullptr;
  const std::function<bool()>* is_so = nullptr;  // what it waits for; null: it runs, or has ended
  Moment deadline{};
  bool result = false;  // of the wait
  bool has_ended = false;
  std::exception_ptr failure;
  std::unique_ptr<Task> task;  // the last member: it uses the others
};

Conductor::Conductor(std::function<void()> wake)
    : wake_(std::move(wake)), executive_(make_one_task_at_a_time()), loop_turn_(executive_->make_event()) {}

Conductor::~Conductor() = default;

void Conductor::run(const std::function<void()>& loop) {
  std::exception_ptr failure;
  is_closed_ = false;
  executive_->run([&] {
    try {
      loop();
    } catch (...) {
      failure = std::current_exception();
    }
    close();
  });
  if (failure) std::rethrow_exception(failure);
}

void Conductor::begin(const std::string& name, std::function<void()> job) {
  auto made = std::make_unique<Job>();
  Job& begun = *made;
  begun.body = std::move(job);
  begun.turn = executive_->make_event();
  jobs_.reserve(jobs_.size() + 1);  // a job without a task, for want of memory, would never end
  begun.task = executive_->spawn({name, 0}, [this, &begun] {
    begun.turn->wait_until(kForever);
    try {
      begun.body();
    } catch (...) {
      begun.failure = std::current_exception();
    }
    begun.has_ended = true;
    begun.resumer->notify();
  });
  jobs_.push_back(std::move(made));
  resume(begun);
  reap();
}

void Conductor::resume(Job& job) {
  Event& mine = current_ == nullptr ? *loop_turn_ : *current_->turn;
  Job* const resumer = std::exchange(current_, &job);
  job.resumer = &mine;
  job.is_so = nullptr;
  job.turn->notify();
  mine.wait_until(kForever);
  current_ = resumer;
}

// Destroys the jobs that have ended, and what they hold.
void Conductor::reap() {
  std::exception_ptr failure;
  for (std::size_t i = 0; i < jobs_.size();) {
    if (!jobs_[i]->has_ended) {
      ++i;
      continue;
    }
    const std::unique_ptr<Job> ended = std::move(jobs_[i]);
    jobs_.erase(jobs_.begin() + static_cast<std::ptrdiff_t>(i));
    if (ended->failure) failure = ended->failure;
  }
  if (failure) std::rethrow_exception(failure);
}

void Conductor::go_on(Moment now) {
  for (bool has_moved = true; std::exchange(has_moved, false);) {
    for (std::size_t i = 0; i < jobs_.size(); ++i) {  // a job may begin others
      Job& job = *jobs_[i];
      if (job.is_so == nullptr) continue;
      job.result = (*job.is_so)();
      if (!job.result && now < job.deadline && !is_closed_) continue;
      resume(job);
      has_moved = true;
    }
    reap();
  }
}

void Conductor::close() {
  is_closed_ = true;
  while (!jobs_.empty()) {
    try {
      go_on(Moment::max());
    } catch (...) {  // of a job that nobody waits for any more
      continue;
    }
  }
}

bool Conductor::wait(const std::function<bool()>& is_so, Moment deadline) {
  if (is_so()) return true;
  if (is_closed_) return false;
  if (current_ == nullptr) throw std::logic_error("the supervisor's loop cannot wait; only its jobs can");
  Job& job = *current_;
  job.is_so = &is_so;
  job.deadline = deadline;
  job.resumer->notify();
  job.turn->wait_until(kForever);
  return job.result;
}

std::optional<Answer> Conductor::ask(Member& member, Order order) {
  const PendingAnswer pending(member, std::move(order));
  wait([&] { return pending.is_over(); });
  return pending.answer();
}

void Conductor::run_aside(const char* name,
                          const std::function<void(const std::function<bool()>& give_up)>& work) {
  std::atomic<bool> is_done{false};
  std::atomic<bool> gives_up{false};
  std::exception_ptr failure;
  std::jthread thread([&] {
    pthread_setname_np(pthread_self(), name);
    try {
      work([&] { return gives_up.load(); });
    } catch (...) {
      failure = std::current_exception();
    }
    is_done = true;
    wake_();
  });
  gives_up = !wait([&] { return is_done.load(); });
  thread.join();
  if (failure) std::rethrow_exception(failure);
}

PendingAnswer::PendingAnswer(Member& member, Order order)
    : answer_(std::make_shared<std::optional<Answer>>()) {
  member.ask_for(std::move(order), [answer = answer_](const Answer& given) { *answer = given; });
}

}  // namespace orca::supervisor
