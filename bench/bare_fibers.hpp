// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cxxabi.h>

#include <boost/context/fiber.hpp>
#include <chrono>
#include <deque>
#include <functional>
#include <memory>
#include <utility>

namespace orca::bench {

/// The two words that the C++ runtime keeps per thread and that each fiber needs for itself.
struct ExceptionWords {
  void* caught = nullptr;
  unsigned int uncaught = 0;
  void exchange() { std::swap(reinterpret_cast<ExceptionWords&>(*abi::__cxa_get_globals()), *this); }
};

/// Bare fibers that hand over to each other through a scheduler. They run in the order of the time at which
/// they became ready, and each keeps its exception words. There are no events, no timers and no other
/// threads.
class BareFibers {
 public:
  struct Fiber {
    boost::context::fiber inside;
    boost::context::fiber outside;
    ExceptionWords exceptions;
    std::chrono::steady_clock::time_point ready_since;
  };

  /// Adds a fiber, which is not ready yet.
  Fiber& add(std::function<void()> body);
  void make_ready(Fiber& fiber);
  /// Leaves the running fiber until it is made ready and its turn comes.
  void leave();
  /// Runs fibers until none is ready.
  void run();

 private:
  std::deque<std::unique_ptr<Fiber>> fibers_;
  std::deque<Fiber*> ready_;
  Fiber* current_ = nullptr;
};

/// Two bare fibers that hand over to each other.
class BareFiberPair {
 public:
  BareFiberPair();
  /// @return time of one hand-over [ns].
  double time(int hand_overs);

 private:
  BareFibers fibers_;
  BareFibers::Fiber* one_ = nullptr;
  BareFibers::Fiber* other_ = nullptr;
  int left_ = 0;
};

/// A jump of Boost.Context into a fiber and back, and nothing else.
class BareJump {
 public:
  BareJump();
  double time(int jumps);

 private:
  boost::context::fiber fiber_;
};

}  // namespace orca::bench
