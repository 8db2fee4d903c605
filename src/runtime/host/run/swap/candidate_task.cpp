// SPDX-License-Identifier: LGPL-3.0-or-later
#include "candidate_task.hpp"

#include <utility>

#include "orca/base/stall_watch.hpp"

namespace orca::host {
namespace {

constexpr Duration kMostComputing = 500ms;  // while it is past its limit: whoever takes more does not sleep

}  // namespace

void CandidateTask::enter(Duration limit) {
  limit_ = saturating_add(run_.executive.now(), limit);
  computed_ = clock_.used();
}

void CandidateTask::begin(Duration limit, std::function<void()> body) {
  clock_.reset();
  enter(limit);
  is_done_.store(false);
  task_ = run_.executive.spawn({"swap", 0}, [this, body = std::move(body)] {
    start_clock();
    body();
    is_done_.store(true, std::memory_order_release);
    run_.changed();
  });
}

void CandidateTask::start_clock() {
  leave_stall_watch();
  clock_.start();
}

bool CandidateTask::computes() const { return clock_.used() - computed_ > kMostComputing; }

}  // namespace orca::host
