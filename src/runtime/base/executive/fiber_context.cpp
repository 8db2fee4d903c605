// SPDX-License-Identifier: LGPL-3.0-or-later
#include <cxxabi.h>

#include <boost/context/fiber.hpp>
#include <boost/context/protected_fixedsize_stack.hpp>
#include <utility>

#include "context.hpp"
#include "orca/base/activity.hpp"
#include "sanitizer.hpp"

namespace orca::detail {
namespace {

namespace bc = boost::context;

// 256 KiB is too little: std::regex alone overflows it.
#if defined(__SANITIZE_ADDRESS__)
constexpr std::size_t kStackBytes = 8 * 1024 * 1024;  // its red zones make frames several times as large
#else
constexpr std::size_t kStackBytes = 1024 * 1024;
#endif

// The C++ runtime keeps the exceptions being handled per thread, not per fiber. Without swapping these two
// words at every switch a rethrow after a switch inside a handler throws another fiber's exception.
struct ExceptionGlobals {
  void* caught = nullptr;
  unsigned int uncaught = 0;

  void exchange() {
    auto& live = *reinterpret_cast<ExceptionGlobals*>(abi::__cxa_get_globals());
    std::swap(live, *this);
  }
};

StackBounds bounds_of(const bc::stack_context& stack) {
  return {static_cast<char*>(stack.sp) - stack.size, stack.size};
}

// The fiber keeps a copy and frees its stack with it, when it has left it for good.
struct StackAllocator {
  bc::protected_fixedsize_stack pages{kStackBytes};
  bc::stack_context allocate() { return pages.allocate(); }
  void deallocate(bc::stack_context& stack) {
    forget_stack(bounds_of(stack));
    pages.deallocate(stack);
  }
};

class FiberContext final : public Context {
 public:
  explicit FiberContext(std::function<void()> body) : body_(std::move(body)) {
    StackAllocator allocator;
    bc::stack_context stack = allocator.allocate();
    fiber_stack_ = bounds_of(stack);
    inside_ = bc::fiber(std::allocator_arg, bc::preallocated(stack.sp, stack.size, stack), allocator,
                        [this](bc::fiber&& caller) { return run(std::move(caller)); });
  }

  void resume() override {
    exceptions_.exchange();
    activity_.exchange();
    start_switch(&caller_fake_stack_, fiber_stack_);
    inside_ = std::move(inside_).resume();
    finish_switch(caller_fake_stack_, nullptr);
    activity_.exchange();
    exceptions_.exchange();
  }

  void suspend() override {
    start_switch(&fiber_fake_stack_, caller_stack_);
    outside_ = std::move(outside_).resume();
    finish_switch(fiber_fake_stack_, &caller_stack_);
  }

 private:
  bc::fiber run(bc::fiber&& caller) {
    finish_switch(nullptr, &caller_stack_);
    outside_ = std::move(caller);
    body_();
    start_switch(nullptr, caller_stack_);  // null: this stack is left for good
    return std::move(outside_);
  }

  std::function<void()> body_;
  StackBounds fiber_stack_;
  StackBounds caller_stack_;
  void* caller_fake_stack_ = nullptr;
  void* fiber_fake_stack_ = nullptr;
  ExceptionGlobals exceptions_;
  ActivityKeeper activity_;
  bc::fiber inside_;
  bc::fiber outside_;
};

}  // namespace

std::unique_ptr<Context> make_fiber_context(std::function<void()> body) {
  return std::make_unique<FiberContext>(std::move(body));
}

}  // namespace orca::detail
