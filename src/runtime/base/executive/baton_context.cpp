// SPDX-License-Identifier: LGPL-3.0-or-later
#include <condition_variable>
#include <mutex>
#include <thread>
#include <utility>

#include "context.hpp"

namespace orca::detail {
namespace {

// A thread that runs only between resume() and suspend(): the baton is the right to run.
class BatonContext final : public Context {
 public:
  explicit BatonContext(std::function<void()> body)
      : thread_([this, run = std::move(body)] {
          take(Holder::inside);
          run();
          give(Holder::outside);
        }) {}
  ~BatonContext() override { thread_.join(); }

  void resume() override {
    give(Holder::inside);
    take(Holder::outside);
  }

  void suspend() override {
    give(Holder::outside);
    take(Holder::inside);
  }

 private:
  enum class Holder { outside, inside };

  void give(Holder to) {
    const std::lock_guard lock(mutex_);
    holder_ = to;
    changed_.notify_all();
  }

  void take(Holder me) {
    std::unique_lock lock(mutex_);
    changed_.wait(lock, [&] { return holder_ == me; });
  }

  std::mutex mutex_;
  std::condition_variable changed_;
  Holder holder_ = Holder::outside;
  std::thread thread_;
};

}  // namespace

std::unique_ptr<Context> make_baton_context(std::function<void()> body) {
  return std::make_unique<BatonContext>(std::move(body));
}

}  // namespace orca::detail
