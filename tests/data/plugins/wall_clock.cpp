// SPDX-License-Identifier: GPL-3.0-or-later
#include <unistd.h>

#include <cstdlib>

#include "orca/component.hpp"

namespace {

/// Uses the machine's time and random numbers without a seed, as no component should.
class WallClock final : public orca::Component {
 public:
  using Component::Component;

 private:
  orca::Outcome work() override {
    usleep(1000);
    return rand() % 2 == 0 ? orca::again() : orca::done();
  }
};

}  // namespace

ORCA_COMPONENT(WallClock, "test.WallClock")
