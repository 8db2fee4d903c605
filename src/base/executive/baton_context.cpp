// SPDX-License-Identifier: LGPL-3.0-or-later
#include <thread>
#include <utility>

#include "context.hpp"
#include "futex_event.hpp"

namespace orca::detail {
namespace {

// The right to run, which one thread waits for.
class Baton {
 public:
  void pass() { passed_.notify(); }
  void await() { passed_.wait_until(kForever); }

 private:
  FutexEvent passed_{Duration{0}};
};

// A thread that runs only while it holds the baton.
class BatonContext final : public Context {
 public:
  BatonContext(Baton& scheduler, std::function<void()> body)
      : scheduler_(scheduler), thread_([this, run = std::move(body)] {
          mine_.await();
          run();
          scheduler_.pass();
        }) {}
  ~BatonContext() override { thread_.join(); }

  void enter() override {
    mine_.pass();
    scheduler_.await();
  }

  void hand_over(Context& next) override {
    static_cast<BatonContext&>(next).mine_.pass();
    mine_.await();
  }

 private:
  Baton& scheduler_;
  Baton mine_;
  std::thread thread_;
};

class BatonContexts final : public ContextMaker {
 public:
  [[nodiscard]] bool share_a_thread() const override { return false; }
  std::unique_ptr<Context> make(std::function<void()> body) override {
    return std::make_unique<BatonContext>(scheduler_, std::move(body));
  }

 private:
  Baton scheduler_;
};

}  // namespace

std::unique_ptr<ContextMaker> make_baton_contexts() { return std::make_unique<BatonContexts>(); }

}  // namespace orca::detail
