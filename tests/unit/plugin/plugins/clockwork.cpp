// SPDX-License-Identifier: GPL-3.0-or-later
// Uses everything that is forbidden in virtual time.
#include <sys/random.h>
#include <unistd.h>

#include <chrono>
#include <condition_variable>
#include <cstdlib>
#include <mutex>
#include <random>
#include <thread>

#include "orca/component.hpp"

namespace {

class Clockwork final : public orca::Component {
 public:
  using Component::Component;
  orca::Outcome work() override {
    std::mutex mutex;
    std::unique_lock lock(mutex);
    std::condition_variable condition;
    std::thread([&] { condition.notify_one(); }).detach();
    condition.wait(lock);
    usleep(static_cast<useconds_t>(rand()));
    std::this_thread::sleep_for(std::chrono::nanoseconds(std::random_device()()));
    unsigned number = 0;
    const bool drawn = getrandom(&number, sizeof number, 0) > 0;
    const auto now = std::chrono::steady_clock::now().time_since_epoch() +
                     std::chrono::system_clock::now().time_since_epoch();
    return drawn && now.count() > time(nullptr) ? orca::again() : orca::done();
  }
};

}  // namespace

ORCA_COMPONENT(Clockwork, "test.Clockwork")
