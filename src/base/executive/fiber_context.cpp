// SPDX-License-Identifier: LGPL-3.0-or-later
#include <cxxabi.h>
#include <sys/mman.h>

#include <boost/context/fiber.hpp>
#include <boost/context/protected_fixedsize_stack.hpp>
#include <utility>

#include "context.hpp"
#include "orca/base/activity.hpp"
#include "sanitizer.hpp"

namespace orca::detail {
namespace {

namespace bc = boost::context;

// As much as a thread usually has, so that a component that works on threads works here, too. Only the part that is
// used takes memory.
constexpr std::size_t kStackBytes = 8 * 1024 * 1024;

// The C++ runtime keeps the exceptions being handled per thread, not per fiber. These two words are exchanged
// at every switch. Otherwise a rethrow after a switch inside a handler would throw another fiber's exception.
struct ExceptionGlobals {
  void* caught = nullptr;
  unsigned int uncaught = 0;
};

ExceptionGlobals& live_exceptions() { return *reinterpret_cast<ExceptionGlobals*>(abi::__cxa_get_globals()); }

StackBounds bounds_of(const bc::stack_context& stack) {
  return {static_cast<char*>(stack.sp) - stack.size, stack.size};
}

// The fiber keeps a copy of the allocator, and frees its stack with it when it has left the stack for good.
struct StackAllocator {
  bc::protected_fixedsize_stack pages{kStackBytes};
  bc::stack_context allocate() {
    bc::stack_context stack = pages.allocate();
    // One page of 2 MB for a few kilobytes of stack would be a waste.
    madvise(static_cast<char*>(stack.sp) - stack.size, stack.size, MADV_NOHUGEPAGE);
    return stack;
  }
  void deallocate(bc::stack_context& stack) {
    forget_stack(bounds_of(stack));
    pages.deallocate(stack);
  }
};

// A flow of control that is suspended while another one runs on the thread: where it resumes, its stack, and
// the thread's state that belongs to it.
struct Flow {
  bc::fiber rest;
  StackBounds stack;
  void* fake_stack = nullptr;
  ExceptionGlobals exceptions;
  ActivityKeeper activity;
};

// The switch between the scheduler and its fibers, of which one runs at a time.
class FlowSwitch {
 public:
  Flow scheduler;

  // Call before the scheduler is left: it may run on another thread than last time.
  void begin() { live_exceptions_ = &live_exceptions(); }

  void go(Flow& from, Flow& to) {
    exchange(from, to);
    start_switch(&from.fake_stack, to.stack);
    arrive(std::move(to.rest).resume(), from.fake_stack);
  }

  // Completes a switch. Called in the flow that was entered, with the rest of the flow that was left.
  // `fake_stack` is null in a new flow.
  void arrive(bc::fiber rest, void* fake_stack) {
    left_->rest = std::move(rest);
    finish_switch(fake_stack, &left_->stack);
  }

  // Leaves a flow for good. The caller resumes the returned fiber as its last action.
  bc::fiber end(Flow& ended) {
    exchange(ended, scheduler);
    start_switch(nullptr, scheduler.stack);
    return std::move(scheduler.rest);
  }

 private:
  void exchange(Flow& from, Flow& to) {
    from.exceptions = std::exchange(*live_exceptions_, to.exceptions);
    from.activity.keep();
    to.activity.restore();
    left_ = &from;
  }

  Flow* left_ = nullptr;  // by the last switch
  ExceptionGlobals* live_exceptions_ = nullptr;
};

class FiberContext final : public Context {
 public:
  FiberContext(FlowSwitch& flows, std::function<void()> body) : flows_(flows), body_(std::move(body)) {
    StackAllocator allocator;
    bc::stack_context stack = allocator.allocate();
    flow_.stack = bounds_of(stack);
    flow_.rest = bc::fiber(std::allocator_arg, bc::preallocated(stack.sp, stack.size, stack), allocator,
                           [this](bc::fiber&& caller) { return run(std::move(caller)); });
  }

  void enter() override {
    flows_.begin();
    flows_.go(flows_.scheduler, flow_);
  }

  void hand_over(Context& next) override { flows_.go(flow_, static_cast<FiberContext&>(next).flow_); }

 private:
  bc::fiber run(bc::fiber&& caller) {
    flows_.arrive(std::move(caller), nullptr);
    body_();
    return flows_.end(flow_);
  }

  FlowSwitch& flows_;
  std::function<void()> body_;
  Flow flow_;
};

class FiberContexts final : public ContextMaker {
 public:
  [[nodiscard]] bool share_a_thread() const override { return true; }
  std::unique_ptr<Context> make(std::function<void()> body) override {
    return std::make_unique<FiberContext>(flows_, std::move(body));
  }

 private:
  FlowSwitch flows_;
};

}  // namespace

std::unique_ptr<ContextMaker> make_fiber_contexts() { return std::make_unique<FiberContexts>(); }

}  // namespace orca::detail
