// SPDX-License-Identifier: GPL-3.0-or-later
// Who writes what to DDS: the thread that does so for all, or the one that has a few urgent bytes.
#include "dds/backend/outbox.hpp"

#include <catch2/catch.hpp>

#include <chrono>
#include <future>
#include <thread>

using namespace orca;
using namespace orca::dds;

namespace {

// Notes what is written and by whom. A write of a message that begins with `kHeld` waits until it is let go.
class Notes final : public TopicWriter {
 public:
  static constexpr std::byte kHeld{255};

  bool write(const ObjectRef& /*object*/, std::size_t /*size*/, const Label& /*label*/) override {
    return true;
  }
  bool write(std::vector<std::byte> messages) override {
    if (messages.front() == kHeld) {
      holding.set_value();
      let_go.get_future().wait();
    }
    const std::lock_guard lock(mutex_);
    for (const std::byte message : messages) written_.push_back(std::to_integer<int>(message));
    sizes_.push_back(messages.size());
    by_ = std::this_thread::get_id();
    return true;
  }

  [[nodiscard]] std::vector<int> written() const {
    const std::lock_guard lock(mutex_);
    return written_;
  }
  // Returns how many bytes each write had.
  [[nodiscard]] std::vector<std::size_t> sizes() const {
    const std::lock_guard lock(mutex_);
    return sizes_;
  }
  [[nodiscard]] bool is_by_this_thread() const {
    const std::lock_guard lock(mutex_);
    return by_ == std::this_thread::get_id();
  }

  std::promise<void> holding, let_go;

 private:
  mutable std::mutex mutex_;
  std::vector<int> written_;
  std::vector<std::size_t> sizes_;
  std::thread::id by_;
};

Letter letter(const std::shared_ptr<Notes>& to, std::byte message, std::size_t size = 1) {
  return {to, {}, {}, std::vector<std::byte>(size, message)};
}

}  // namespace

TEST_CASE("a few bytes are written by the thread that has them", "[patterns][dds]") {
  const auto notes = std::make_shared<Notes>();
  Outbox outbox([] {});
  outbox.post(letter(notes, std::byte{1}), By::caller);
  outbox.write_here();
  CHECK(notes->written() == std::vector{1});
  CHECK(notes->is_by_this_thread());
}

TEST_CASE("much is left to the outbox's thread", "[patterns][dds]") {
  const auto notes = std::make_shared<Notes>();
  constexpr std::size_t kMuch = 100'000;
  {
    Outbox outbox([] {});
    outbox.post(letter(notes, std::byte{1}, kMuch), By::caller);
    outbox.write_here();
  }  // writes what waits
  CHECK(notes->written().size() == kMuch);
  CHECK_FALSE(notes->is_by_this_thread());
}

TEST_CASE("up to 4,000 bytes are a few, all that wait together", "[patterns][dds]") {
  for (const std::size_t last : {2000U, 2001U}) {
    const auto notes = std::make_shared<Notes>();
    bool was_here = false;
    {
      Outbox outbox([] {});
      outbox.post(letter(notes, std::byte{1}, 2000), By::caller);
      outbox.post(letter(notes, std::byte{2}, last), By::caller);
      outbox.write_here();
      was_here = last == 2000 && notes->is_by_this_thread();
    }
    CHECK(was_here == (last == 2000));
    CHECK(notes->is_by_this_thread() == (last == 2000));
    CHECK(notes->written().size() == 2000 + last);
  }
}

TEST_CASE("messages to one reader go together as far as one packet carries them", "[patterns][dds]") {
  const auto notes = std::make_shared<Notes>();
  const auto other = std::make_shared<Notes>();
  {
    Outbox outbox([] {});
    outbox.post(letter(notes, Notes::kHeld));
    notes->holding.get_future().wait();
    for (const std::size_t size : {20'000U, 20'000U, 20'000U, 30'000U, 30'001U, 50'000U})
      outbox.post(letter(notes, std::byte{1}, size));
    outbox.post(letter(other, std::byte{2}, 5));
    outbox.post(letter(notes, std::byte{3}, 7));
    notes->let_go.set_value();
  }
  CHECK(notes->sizes() == std::vector<std::size_t>{1, 60'000, 30'000, 30'001, 50'000, 7});
  CHECK(other->sizes() == std::vector<std::size_t>{5});
}

TEST_CASE("who would have to wait for another writer leaves its bytes to the outbox's thread",
          "[patterns][dds]") {
  const auto notes = std::make_shared<Notes>();
  {
    Outbox outbox([] {});
    outbox.post(letter(notes, Notes::kHeld));
    notes->holding.get_future().wait();
    outbox.post(letter(notes, std::byte{1}), By::caller);
    outbox.write_here();  // returns, although the other write does not
    CHECK(notes->written().empty());
    notes->let_go.set_value();
  }
  CHECK(notes->written() == std::vector{255, 1});
  CHECK_FALSE(notes->is_by_this_thread());
}

TEST_CASE("what may wait is written at the next tick, by the outbox's thread", "[patterns][dds]") {
  const auto notes = std::make_shared<Notes>();
  Outbox outbox([] {});
  outbox.post(letter(notes, std::byte{1}), By::next);
  outbox.post(letter(notes, std::byte{2}), By::next);
  const auto limit = std::chrono::steady_clock::now() + std::chrono::seconds(10);
  while (notes->written().size() < 2 && std::chrono::steady_clock::now() < limit)
    std::this_thread::sleep_for(Line::kTick);
  CHECK(notes->written() == std::vector{1, 2});
  CHECK_FALSE(notes->is_by_this_thread());
}

TEST_CASE("what is posted after the end is not written", "[patterns][dds]") {
  const auto notes = std::make_shared<Notes>();
  Outbox outbox([] {});
  outbox.post(letter(notes, std::byte{1}));
  outbox.end();
  outbox.post(letter(notes, std::byte{2}));
  CHECK(notes->written() == std::vector{1});
}

TEST_CASE("what one thread posts is written in its order, whoever writes it", "[patterns][dds]") {
  constexpr int kMessages = 2'000;
  constexpr int kThreads = 3;
  const auto notes = std::make_shared<Notes>();
  {
    Outbox outbox([] {});
    std::vector<std::thread> threads;
    for (int thread = 0; thread < kThreads; ++thread)
      threads.emplace_back([&, thread] {
        for (int i = 0; i < kMessages; ++i) {
          const By by = i % 3 == 0 ? By::outbox : By::caller;
          outbox.post(letter(notes, std::byte(64 * thread + i % 60)), by);
          if (by == By::caller) outbox.write_here();
        }
      });
    for (std::thread& thread : threads) thread.join();
  }
  std::vector<int> next(kThreads, 0);
  for (const int message : notes->written()) {
    const auto thread = static_cast<std::size_t>(message / 64);
    REQUIRE(message % 64 == next[thread] % 60);
    ++next[thread];
  }
  CHECK(next == std::vector<int>(kThreads, kMessages));
}
