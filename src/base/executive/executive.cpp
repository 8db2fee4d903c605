// SPDX-License-Identifier: LGPL-3.0-or-later
#include "orca/base/executive.hpp"

#include <utility>

#include "cooperative.hpp"
#include "futex_event.hpp"
#include "orca/base/system/pace.hpp"
#include "task_thread.hpp"
#include "thread_executive.hpp"

namespace orca {

constinit thread_local const Executive* detail::t_executive = nullptr;

detail::TaskThread::TaskThread(const Executive& executive) noexcept
    : outer_(std::exchange(t_executive, &executive)) {}

detail::TaskThread::~TaskThread() { t_executive = outer_; }

void Executive::sleep_until(TimePoint time) {
  const std::unique_ptr<Event> alarm = make_event();
  while (now() < time) alarm->wait_until(time);
}

namespace {

Result<std::unique_ptr<Executive>> make(const ExecutiveOptions& options, Pace* pace) {
  if (options.doorbell != nullptr && options.clock == ClockKind::virtual_time)
    return fail(Code::invalid_argument,
                "virtual time does not wait for other processes, so it has no doorbell");
  if (options.backend == Backend::thread) {
    if (options.clock == ClockKind::virtual_time)
      return fail(
          Code::invalid_argument,
          "the thread executor cannot run in virtual time, because its order is the operating system's; "
          "take --executor fiber or baton");
    return std::unique_ptr<Executive>(
        std::make_unique<detail::ThreadExecutive>(detail::useful_spin(options.spin)));
  }
  auto contexts =
      options.backend == Backend::fiber ? detail::make_fiber_contexts() : detail::make_baton_contexts();
  return std::unique_ptr<Executive>(std::make_unique<detail::CooperativeExecutive>(
      options.clock, std::move(contexts), detail::useful_spin(options.spin), options.doorbell, pace));
}

}  // namespace

Result<std::unique_ptr<Executive>> make_executive(const ExecutiveOptions& options) {
  return make(options, nullptr);
}

Result<std::unique_ptr<Executive>> make_paced_executive(const ExecutiveOptions& options, Pace& pace) {
  if (options.clock != ClockKind::virtual_time)
    return fail(Code::invalid_argument, "only virtual time has a pace");
  return make(options, &pace);
}

}  // namespace orca
