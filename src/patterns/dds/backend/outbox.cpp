// SPDX-License-Identifier: LGPL-3.0-or-later
#include "outbox.hpp"

#include <pthread.h>

#include <chrono>
#include <span>
#include <utility>

namespace orca::dds {
namespace {

using Clock = std::chrono::steady_clock;

using Letters = std::span<Letter>;

constexpr std::size_t kMostTogether = 60'000;  // [bytes] what one packet of UDP carries
constexpr std::size_t kFew = 4'000;  // [bytes] that a component may write itself: 0.3 ms at 100 Mbit/s

// Takes the message off the first letter, and those that follow it to the same reader: a sample takes far longer than its bytes.
std::vector<std::byte> take_messages(Letters& letters) {
  const auto& to = letters.front().to;
  std::vector<std::byte> messages = std::move(letters.front().message);
  letters = letters.subspan(1);
  while (!letters.empty() && letters.front().to == to &&
         messages.size() + letters.front().message.size() <= kMostTogether) {
    const std::vector<std::byte>& next = letters.front().message;
    messages.insert(messages.end(), next.begin(), next.end());
    letters = letters.subspan(1);
  }
  return messages;
}

// Writes one letter or several. A write that DDS refuses is a loss like one of the network: readers count it, or the line
// repeats it.
void write_some(Letters& letters) {
  const Letter& letter = letters.front();
  if (!letter.object) {
    letter.to->write(take_messages(letters));
  } else {
    letter.to->write(letter.object, letter.size, letter.label);
    letter.to->queued.fetch_sub(letter.size, std::memory_order_relaxed);
    letters = letters.subspan(1);
  }
}

}  // namespace

Outbox::Outbox(std::function<void()> tick)
    : tick_(std::move(tick)), thread_([this] {
        pthread_setname_np(pthread_self(), "dds writer");
        work();
      }) {}

Outbox::~Outbox() { end(); }

void Outbox::end() {
  {
    const MutexLock lock(mutex_);
    ending_ = true;
  }
  changed_.notify_one();
  if (thread_.joinable()) thread_.join();
}

void Outbox::post(Letter letter, By by) {
  if (letter.object) letter.to->queued.fetch_add(letter.size, std::memory_order_relaxed);
  {
    const MutexLock lock(mutex_);
    letters_.push_back(std::move(letter));
  }
  if (by == By::outbox) changed_.notify_one();
}

void Outbox::write_here() {
  if (!writing_.try_lock()) return changed_.notify_one();
  const MutexLock writing(writing_, std::adopt_lock);
  if (!take_few()) return changed_.notify_one();
  write_taken();
}

// Takes what waits, if a component may write that much.
bool Outbox::take_few() {
  const MutexLock lock(mutex_);
  std::size_t bytes = 0;
  for (const Letter& letter : letters_) bytes += letter.size + letter.message.size();
  if (bytes > kFew) return false;
  take();
  return true;
}

// Takes what waits. The rest of a write that threw is lost, as in the network.
void Outbox::take() {
  taken_.clear();
  taken_.swap(letters_);
}

void Outbox::write_taken() {
  for (Letters left = taken_; !left.empty();) write_some(left);
  taken_.clear();
}

void Outbox::write_all() {
  const MutexLock writing(writing_);
  {
    const MutexLock lock(mutex_);
    take();
  }
  write_taken();
}

// Waits for letters. Returns false if there will be none any more.
bool Outbox::wait(Clock::time_point until) {
  MutexLock lock(mutex_);
  changed_.wait_until(lock.native(), until,
                      [this]() ORCA_REQUIRES(mutex_) { return ending_ || !letters_.empty(); });
  return !ending_ || !letters_.empty();
}

void Outbox::work() {
  Clock::time_point next_tick = Clock::now();
  while (wait(next_tick)) {
    write_all();
    if (const Clock::time_point now = Clock::now(); now >= next_tick) {
      tick_();
      next_tick = now + Line::kTick;
    }
  }
}

}  // namespace orca::dds
