// SPDX-License-Identifier: LGPL-3.0-or-later
#include "cooperative.hpp"

#include <pthread.h>
#include <sys/syscall.h>
#include <sys/types.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cassert>
#include <ctime>
#include <fstream>
#include <string>
#include <utility>

#include "orca/base/steady_clock.hpp"
#include "task_thread.hpp"
#include "turn_time.hpp"

namespace orca::detail {

struct CooperativeExecutive::Fiber {
  std::string name;
  int priority = 0;
  std::unique_ptr<Context> context;
  std::unique_ptr<Event> ended_event;
  bool ended = false;
  bool ready = false;
  FiberTime time{};
  std::uint32_t turns = 0;  // at `instant`
  TimePoint instant{};
  Fiber* before = nullptr;  // in the ready queue
  Fiber* after = nullptr;
  std::optional<Timers::iterator> timer;
  Timers::node_type timer_place;  // kept between two uses, so that a wait allocates nothing
  std::atomic<pthread_t> thread{};
  std::atomic<pid_t> thread_id{0};
};

class CooperativeEvent final : public Event {
 public:
  explicit CooperativeEvent(CooperativeExecutive& executive) : executive_(executive) {}
  ~CooperativeEvent() override { executive_.forget_notifications(*this); }

  void notify() override {
    if (executive_.runs_here()) {
      notify_inside();
    } else {
      executive_.post_notification(*this);
    }
  }

  void notify_inside() {
    notified_ = true;
    if (waiter_ != nullptr) executive_.make_ready(*waiter_);
  }

  // Used by the executive, under the lock of its inbox.
  bool posted = false;

  bool wait_until(TimePoint deadline) override {
    if (!notified_ && (deadline == kForever || deadline > executive_.now())) {
      waiter_ = executive_.current();
      executive_.block_until(deadline);
      waiter_ = nullptr;
    }
    return std::exchange(notified_, false);
  }

 private:
  CooperativeExecutive& executive_;
  CooperativeExecutive::Fiber* waiter_ = nullptr;
  bool notified_ = false;
};

namespace {

// Returns whether a thread of this process sleeps in a system call. A write that waits for its reader does
// not count. Returns false where the system does not report it.
bool sleeps_in_system(pid_t thread) {
  constexpr std::array kWrites{SYS_write, SYS_pwrite64, SYS_writev, SYS_sendto, SYS_sendmsg};
  // Reads "running", or the number of the system call that the thread is in.
  std::ifstream state("/proc/self/task/" + std::to_string(thread) + "/syscall");
  long call = -1;
  return (state >> call) && call >= 0 && std::ranges::find(kWrites, call) == kWrites.end();
}

class CooperativeTask final : public Task {
 public:
  CooperativeTask(CooperativeExecutive& executive, std::unique_ptr<CooperativeExecutive::Fiber> fiber)
      : executive_(executive), fiber_(std::move(fiber)) {}
  ~CooperativeTask() override {
    join_until(kForever);
    executive_.destroy(std::move(fiber_));
  }

  bool join_until(TimePoint deadline) override {
    while (!fiber_->ended && fiber_->ended_event->wait_until(deadline)) {
    }
    return fiber_->ended;
  }

 private:
  CooperativeExecutive& executive_;
  std::unique_ptr<CooperativeExecutive::Fiber> fiber_;
};

Duration cpu_time_of(pthread_t thread) {
  clockid_t clock{};
  timespec time{};
  if (pthread_getcpuclockid(thread, &clock) != 0 || clock_gettime(clock, &time) != 0) return Duration{0};
  return std::chrono::seconds(time.tv_sec) + std::chrono::nanoseconds(time.tv_nsec);
}

}  // namespace

void CooperativeExecutive::ReadyQueue::add(Fiber& fiber) {
  Fiber* before = last_;
  while (by_priority_ && before != nullptr && before->priority < fiber.priority) before = before->before;
  Fiber* const after = before == nullptr ? first_ : before->after;
  fiber.ready = true;
  fiber.before = before;
  fiber.after = after;
  (before == nullptr ? first_ : before->after) = &fiber;
  (after == nullptr ? last_ : after->before) = &fiber;
}

CooperativeExecutive::Fiber& CooperativeExecutive::ReadyQueue::pop() {
  Fiber& fiber = *first_;
  first_ = fiber.after;
  (first_ == nullptr ? last_ : first_->before) = nullptr;
  fiber.ready = false;
  return fiber;
}

void CooperativeExecutive::ReadyQueue::remove(Fiber& fiber) {
  (fiber.before == nullptr ? first_ : fiber.before->after) = fiber.after;
  (fiber.after == nullptr ? last_ : fiber.after->before) = fiber.before;
  fiber.ready = false;
}

CooperativeExecutive::CooperativeExecutive(ClockKind clock, std::unique_ptr<ContextMaker> contexts,
                                           Duration spin, DoorbellWord* doorbell, Pace* pace)
    : clock_(clock),
      contexts_(std::move(contexts)),
      doorbell_(doorbell),
      pace_(pace),
      ready_(clock == ClockKind::virtual_time),
      inbox_changed_(spin, doorbell) {
  if (pace_ != nullptr) pace_->on_change([this] { inbox_changed_.notify(); });
}

CooperativeExecutive::~CooperativeExecutive() {
  if (pace_ != nullptr) pace_->on_change(nullptr);
}

TimePoint CooperativeExecutive::now() const {
  return is_virtual() ? TimePoint(Duration(virtual_now_ns_.load(std::memory_order_relaxed))) : steady_now();
}

std::unique_ptr<Event> CooperativeExecutive::make_event() {
  return std::make_unique<CooperativeEvent>(*this);
}

std::unique_ptr<Event> CooperativeExecutive::make_doorbell_event(DoorbellWord& /*own*/) {
  assert(doorbell_ != nullptr);
  auto event = std::make_unique<CooperativeEvent>(*this);
  rung_.push_back(event.get());
  return event;
}

std::unique_ptr<CooperativeExecutive::Fiber> CooperativeExecutive::make_fiber(TaskOptions options,
                                                                              std::function<void()> body) {
  auto fiber = std::make_unique<Fiber>();
  fiber->name = std::move(options.name);
  fiber->priority = options.priority;
  fiber->ended_event = make_event();
  fiber->context = contexts_->make([this, self = fiber.get(), run = std::move(body)] {
    const TaskThread here(*this);
    self->thread_id = gettid();
    self->thread = pthread_self();
    run();
    self->ended = true;
    self->ended_event->notify();
  });
  return fiber;
}

std::unique_ptr<Task> CooperativeExecutive::spawn(TaskOptions options, std::function<void()> body) {
  auto fiber = make_fiber(std::move(options), std::move(body));
  make_ready(*fiber);
  return std::make_unique<CooperativeTask>(*this, std::move(fiber));
}

void CooperativeExecutive::destroy(std::unique_ptr<Fiber> fiber) {
  assert(fiber->ended && !fiber->ready && !fiber->timer);
  const std::lock_guard lock(monitor_mutex_);
  fiber.reset();
}

void CooperativeExecutive::run(std::function<void()> main) {
  const TaskThread here(*this);
  auto fiber = make_fiber({"main", 0}, std::move(main));
  main_ = fiber.get();
  make_ready(*fiber);
  tells_apart_ = contexts_->share_a_thread() && tells_tasks_apart();
  while (!fiber->ended) {
    Fiber& next = next_to_run();
    begin(next);
    if (tells_apart_) begin_turn(next.time);
    next.context->enter();
    if (tells_apart_) end_turn();
  }
  running_.store(nullptr, std::memory_order_release);
  current_ = nullptr;
  main_ = nullptr;
  destroy(std::move(fiber));
}

// Waits, or lets virtual time pass, until a task is ready.
CooperativeExecutive::Fiber& CooperativeExecutive::next_to_run() {
  for (;;) {
    if (doorbell_ != nullptr && inbox_changed_.take()) notify_rung();
    if (inbox_filled_.load(std::memory_order_acquire)) take_notifications();
    if (!is_virtual()) fire_timers();
    if (main_is_next_) {  // whatever else is ready
      main_is_next_ = false;
      make_ready(*main_);
      ready_.remove(*main_);
      return *main_;
    }
    if (!ready_.empty()) return ready_.pop();
    if (is_virtual()) {
      advance_virtual_time();
    } else {
      wait_for_work();
    }
  }
}

inline void CooperativeExecutive::begin(Fiber& fiber) {
  if (is_virtual()) count_turn(fiber);
  current_ = &fiber;
  running_.store(&fiber, std::memory_order_release);
  switches_.store(switches_.load(std::memory_order_relaxed) + 1, std::memory_order_release);
}

void CooperativeExecutive::count_turn(Fiber& fiber) {
  if (&fiber == main_ || restless_) return;
  if (const TimePoint time = now(); fiber.instant != time) {
    fiber.instant = time;
    fiber.turns = 0;
  }
  ++fiber.turns;
  if (fiber.turns == kMostTurns / 2) busy_.push_back(fiber.name);
  if (fiber.turns == kMostTurns) restless_ = main_is_next_ = true;
}

std::vector<std::string> CooperativeExecutive::restless_tasks() const {
  return restless_ ? busy_ : std::vector<std::string>{};
}

void CooperativeExecutive::set_timer(Fiber& fiber, TimePoint deadline) {
  const TimerKey key{deadline, -fiber.priority, sequence_++, &fiber};
  if (fiber.timer_place.empty()) {
    fiber.timer = timers_.insert(key).first;
  } else {
    fiber.timer_place.value() = key;
    fiber.timer = timers_.insert(std::move(fiber.timer_place)).position;
  }
}

void CooperativeExecutive::cancel_timer(Fiber& fiber) {
  if (!fiber.timer) return;
  fiber.timer_place = timers_.extract(*fiber.timer);
  fiber.timer.reset();
}

void CooperativeExecutive::make_ready(Fiber& fiber) {
  if (fiber.ready) return;
  cancel_timer(fiber);
  ready_.add(fiber);
}

void CooperativeExecutive::block_until(TimePoint deadline) {
  Fiber& leaving = *current_;
  if (deadline != kForever) set_timer(leaving, deadline);
  if (tells_apart_) end_turn();
  Fiber& next = next_to_run();
  begin(next);
  if (tells_apart_) begin_turn(next.time);
  if (&next != &leaving) leaving.context->hand_over(*next.context);
}

void CooperativeExecutive::fire_timers() {
  if (timers_.empty()) return;
  const TimePoint time = now();
  while (!timers_.empty() && std::get<TimePoint>(*timers_.begin()) <= time) {
    make_ready(*std::get<Fiber*>(*timers_.begin()));
  }
}

// Lets virtual time pass on to the next moment. If its pace does not allow that yet, it waits until it does, or somebody
// outside notifies an event.
void CooperativeExecutive::advance_virtual_time() {
  if (!restless_) busy_.clear();
  if (timers_.empty()) {
    make_ready(*main_);  // no task can ever run again, so main's wait ends
    return;
  }
  const TimePoint next = std::get<TimePoint>(*timers_.begin());
  if (const auto until = pace_ != nullptr ? pace_->hold_before(next) : std::nullopt) {
    running_.store(nullptr, std::memory_order_release);  // the task that ran last is not stuck
    (void)inbox_changed_.wait_until(*until);
    return;
  }
  virtual_now_ns_.store(next.time_since_epoch().count(), std::memory_order_relaxed);
  fire_timers();
}

void CooperativeExecutive::wait_for_work() {
  running_.store(nullptr, std::memory_order_release);  // a task that waits here is not stuck
  if (inbox_changed_.wait_until(timers_.empty() ? kForever : std::get<TimePoint>(*timers_.begin())))
    notify_rung();
}

void CooperativeExecutive::notify_rung() {
  for (CooperativeEvent* event : rung_) event->notify_inside();
}

void CooperativeExecutive::post_notification(CooperativeEvent& event) {
  {
    const std::lock_guard lock(inbox_mutex_);
    if (std::exchange(event.posted, true)) return;
    inbox_.push_back(&event);
    inbox_filled_.store(true, std::memory_order_release);
  }
  inbox_changed_.notify();
}

void CooperativeExecutive::forget_notifications(CooperativeEvent& event) {
  std::erase(rung_, &event);
  const std::lock_guard lock(inbox_mutex_);
  std::erase(inbox_, &event);
}

void CooperativeExecutive::take_notifications() {
  const std::lock_guard lock(inbox_mutex_);
  for (CooperativeEvent* event : inbox_) {
    event->posted = false;
    event->notify_inside();
  }
  inbox_.clear();
  inbox_filled_.store(false, std::memory_order_release);
}

std::optional<StuckTask> CooperativeExecutive::stuck_task(Duration limit) {
  const std::lock_guard lock(monitor_mutex_);
  const std::uint64_t switches = switches_.load(std::memory_order_acquire);
  const Fiber* const fiber = running_.load(std::memory_order_acquire);
  if (fiber == nullptr || fiber->thread == pthread_t{}) return std::nullopt;
  const Duration cpu = cpu_time_of(fiber->thread);
  if (switches != observed_switches_) {
    observed_switches_ = switches;
    cpu_at_observation_ = cpu;
    awake_at_ = steady_now();
    return std::nullopt;
  }
  if (sleeps_too_long(*fiber, limit)) return StuckTask{fiber->name, true, true};
  if (cpu - cpu_at_observation_ <= limit) return std::nullopt;
  return StuckTask{fiber->name, false, true};
}

bool CooperativeExecutive::sleeps_too_long(const Fiber& fiber, Duration limit) {
  const TimePoint now = steady_now();
  if (!sleeps_in_system(fiber.thread_id)) awake_at_ = now;
  return now - awake_at_ > limit;
}

}  // namespace orca::detail
