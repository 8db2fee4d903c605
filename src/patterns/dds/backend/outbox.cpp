// SPDX-License-Identifier: LGPL-3.0-or-later
#include "outbox.hpp"

#include <pthread.h>

#include <chrono>
#include <utility>

namespace orca::dds {
namespace {

using Clock = std::chrono::steady_clock;

// A write that DDS refuses is a loss like one of the network: readers count it, or the line repeats it.
void write(Letter& letter) {
  if (letter.object) {
    letter.to->write(letter.object, letter.size, letter.label);
    letter.to->queued.fetch_sub(letter.size, std::memory_order_relaxed);
  } else {
    letter.to->write(std::move(letter.message));
  }
}

}  // namespace

Outbox::Outbox(std::function<void()> tick)
    : tick_(std::move(tick)), thread_([this] {
        pthread_setname_np(pthread_self(), "dds writer");
        work();
      }) {}

Outbox::~Outbox() {
  {
    const std::lock_guard lock(mutex_);
    ending_ = true;
  }
  changed_.notify_one();
  thread_.join();
}

void Outbox::post(Letter letter) {
  if (letter.object) letter.to->queued.fetch_add(letter.size, std::memory_order_relaxed);
  {
    const std::lock_guard lock(mutex_);
    letters_.push_back(std::move(letter));
  }
  changed_.notify_one();
}

// Waits for letters, and takes them. Returns false if there will be none any more.
bool Outbox::wait(std::vector<Letter>& letters, Clock::time_point until) {
  std::unique_lock lock(mutex_);
  changed_.wait_until(lock, until, [this] { return ending_ || !letters_.empty(); });
  letters.swap(letters_);
  return !ending_ || !letters.empty();
}

void Outbox::work() {
  std::vector<Letter> letters;
  Clock::time_point next_tick = Clock::now();
  while (wait(letters, next_tick)) {
    for (Letter& letter : letters) write(letter);
    letters.clear();
    if (const Clock::time_point now = Clock::now(); now >= next_tick) {
      tick_();
      next_tick = now + Line::kTick;
    }
  }
}

}  // namespace orca::dds
