// SPDX-License-Identifier: GPL-3.0-or-later
#include "bare_fibers.hpp"

#include <boost/context/protected_fixedsize_stack.hpp>

#include "comparison.hpp"

namespace orca::bench {
namespace {

namespace bc = boost::context;
constexpr std::size_t kStackBytes = 256 * 1024;

}  // namespace

BareFibers::Fiber& BareFibers::add(std::function<void()> body) {
  Fiber& fiber = *fibers_.emplace_back(std::make_unique<Fiber>());
  fiber.inside = bc::fiber(std::allocator_arg, bc::protected_fixedsize_stack(kStackBytes),
                           [&fiber, run = std::move(body)](bc::fiber&& caller) {
                             fiber.outside = std::move(caller);
                             run();
                             return std::move(fiber.outside);
                           });
  return fiber;
}

void BareFibers::make_ready(Fiber& fiber) {
  fiber.ready_since = std::chrono::steady_clock::now();
  ready_.push_back(&fiber);
}

void BareFibers::leave() { current_->outside = std::move(current_->outside).resume(); }

void BareFibers::run() {
  while (!ready_.empty()) {
    current_ = ready_.front();
    ready_.pop_front();
    current_->exceptions.exchange();
    current_->inside = std::move(current_->inside).resume();
    current_->exceptions.exchange();
  }
}

BareFiberPair::BareFiberPair() {
  const auto hand_over_to = [this](BareFibers::Fiber*& other) {
    for (;;) {
      if (left_-- > 0) fibers_.make_ready(*other);
      fibers_.leave();
    }
  };
  one_ = &fibers_.add([this, hand_over_to] { hand_over_to(other_); });
  other_ = &fibers_.add([this, hand_over_to] { hand_over_to(one_); });
}

double BareFiberPair::time(int hand_overs) {
  left_ = hand_overs - 1;
  return time_per_operation(hand_overs, [this] {
    fibers_.make_ready(*one_);
    fibers_.run();
  });
}

BareJump::BareJump()
    : fiber_(std::allocator_arg, bc::protected_fixedsize_stack(kStackBytes), [](bc::fiber&& caller) {
        for (;;) caller = std::move(caller).resume();
        return std::move(caller);
      }) {}

double BareJump::time(int jumps) {
  return time_per_operation(jumps, [&] {
    for (int i = 0; i < jumps; ++i) fiber_ = std::move(fiber_).resume();
  });
}

}  // namespace orca::bench
