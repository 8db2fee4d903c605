// SPDX-License-Identifier: LGPL-3.0-or-later
#include "orca/base/distant_log.hpp"

#include <utility>
#include <vector>

#include "orca/base/log_mute.hpp"
#include "orca/base/mutex.hpp"

namespace orca::log {
namespace {

struct Listeners {
  Mutex mutex;
  std::vector<const DistantListener*> all ORCA_GUARDED_BY(mutex);
};

// Never destroyed: threads may pass lines on while the process ends.
Listeners& listeners() {
  static Listeners* const instance = new Listeners;
  return *instance;
}

}  // namespace

DistantListener::DistantListener(std::function<void(const Line&)> heard) : heard_(std::move(heard)) {
  const MutexLock lock(listeners().mutex);
  listeners().all.push_back(this);
}

DistantListener::~DistantListener() {
  const MutexLock lock(listeners().mutex);
  std::erase(listeners().all, this);
}

bool wants_distant() {
  if (is_muted()) return false;
  const MutexLock lock(listeners().mutex);
  return !listeners().all.empty();
}

void hear_distant(const Line& line) {
  if (is_muted()) return;
  const MutexLock lock(listeners().mutex);
  for (const DistantListener* const listener : listeners().all) listener->heard_(line);
}

}  // namespace orca::log
