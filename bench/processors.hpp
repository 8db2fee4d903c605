// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <sched.h>

namespace orca::bench {

/// The processors that this thread, and those it starts, may use.
class Processors {
 public:
  /// Those of the calling thread.
  static Processors usable();

  [[nodiscard]] int count() const { return CPU_COUNT(&set_); }
  /// The first of them alone: what runs there meets no other core's caches, and needs none woken.
  [[nodiscard]] Processors one() const;
  /// Restricts the calling thread to these.
  void use() const;

 private:
  cpu_set_t set_{};
};

/// All that the program was started with.
Processors& at_start();

/// Allows the calling thread all processors as long as this lives; then one again.
class AllProcessors {
 public:
  AllProcessors() { at_start().use(); }
  ~AllProcessors() { at_start().one().use(); }
  AllProcessors(const AllProcessors&) = delete;
  AllProcessors& operator=(const AllProcessors&) = delete;
};

}  // namespace orca::bench
