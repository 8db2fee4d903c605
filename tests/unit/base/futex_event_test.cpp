// SPDX-License-Identifier: GPL-3.0-or-later
#include "futex_event.hpp"

#include <sched.h>

#include <catch2/catch.hpp>

using namespace orca;
using orca::detail::useful_spin;

namespace {

// Restricts this thread to some of the processors that it may use, for its lifetime.
class Processors {
 public:
  Processors() { REQUIRE(sched_getaffinity(0, sizeof before_, &before_) == 0); }
  ~Processors() { sched_setaffinity(0, sizeof before_, &before_); }
  Processors(const Processors&) = delete;
  Processors& operator=(const Processors&) = delete;

  // Returns whether there are so many.
  bool use_only(int count) {
    if (CPU_COUNT(&before_) < count) return false;
    cpu_set_t some;
    CPU_ZERO(&some);
    for (std::size_t cpu = 0; CPU_COUNT(&some) < count; ++cpu)
      if (CPU_ISSET(cpu, &before_)) CPU_SET(cpu, &some);
    return sched_setaffinity(0, sizeof some, &some) == 0;
  }

 private:
  cpu_set_t before_{};
};

}  // namespace

TEST_CASE("spinning is of use only where the notifier can have a processor of its own", "[base][event]") {
  Processors processors;
  REQUIRE(processors.use_only(1));
  CHECK(useful_spin(50us) == 0s);
  if (!processors.use_only(2)) {
    WARN("only one processor: not tested with two");
    return;
  }
  CHECK(useful_spin(50us) == 50us);
  CHECK(useful_spin(0s) == 0s);
}
