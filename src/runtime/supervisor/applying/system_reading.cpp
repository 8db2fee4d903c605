// SPDX-License-Identifier: LGPL-3.0-or-later
#include "applying/system_reading.hpp"

#include <pthread.h>

#include <utility>

namespace orca::supervisor {

SystemReading::SystemReading(SystemReader read, GraphSource source, std::function<void()> done) {
  thread_ = std::thread([this, read = std::move(read), source = std::move(source), done = std::move(done)] {
    pthread_setname_np(pthread_self(), "reading");
    outcome_.emplace(read(source));
    done_.store(true, std::memory_order_release);
    done();
  });
}

}  // namespace orca::supervisor
