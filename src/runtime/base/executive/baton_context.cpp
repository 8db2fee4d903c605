// SPDX-License-Identifier: LGPL-3.0-or-later
#include <thread>
#include <utility>

#include "context.hpp"
#include "futex_event.hpp"

namespace orca::detail {
namespace {

// A thread that runs only between resume() and suspend(): the baton is the right to run.
class BatonContext final : public Context {
 public:
  explicit BatonContext(std::function<void()> body)
      : thread_([this, run = std::move(body)] {
          inside_.wait_until(kForever);
          run();
          outside_.notify();
        }) {}
  ~BatonContext() override { thread_.join(); }

  void resume() override {
    inside_.notify();
    outside_.wait_until(kForever);
  }

  void suspend() override {
    outside_.notify();
    inside_.wait_until(kForever);
  }

 private:
  FutexEvent inside_{Duration{0}};   // the baton for the thread
  FutexEvent outside_{Duration{0}};  // the baton for whoever resumed it
  std::thread thread_;
};

}  // namespace

std::unique_ptr<Context> make_baton_context(std::function<void()> body) {
  return std::make_unique<BatonContext>(std::move(body));
}

}  // namespace orca::detail
