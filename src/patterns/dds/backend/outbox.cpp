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
    for (Letters left = letters; !left.empty();) write_some(left);
    letters.clear();
    if (const Clock::time_point now = Clock::now(); now >= next_tick) {
      tick_();
      next_tick = now + Line::kTick;
    }
  }
}

}  // namespace orca::dds
