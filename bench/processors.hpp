// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <sched.h>

namespace orca::bench {

/// A set of processors that a thread, and the threads that it starts, may use.
class Processors {
 public:
  /// Returns the processors that the calling thread may use.
  static Processors usable();

  [[nodiscard]] int count() const { return CPU_COUNT(&set_); }
  /// Returns the first of them alone. A program that runs on it needs no other core's cache and wakes no
  /// other core.
  [[nodiscard]] Processors one() const;
  /// Restricts the calling thread to these processors.
  void use() const;

 private:
  cpu_set_t set_{};
};

/// Returns all processors that the program was started with.
Processors& at_start();

/// A scope in which the calling thread may use all processors; afterwards it is restricted to one again.
class AllProcessors {
 public:
  AllProcessors() { at_start().use(); }
  ~AllProcessors() { at_start().one().use(); }
  AllProcessors(const AllProcessors&) = delete;
  AllProcessors& operator=(const AllProcessors&) = delete;
};

}  // namespace orca::bench
