// SPDX-License-Identifier: GPL-3.0-or-later
// A plugin that declares that it needs the steady clock.
#include <poll.h>

#include "orca/component.hpp"

namespace {

class Stick final : public orca::Component {
 public:
  using Component::Component;
  orca::Outcome work() override { return poll(nullptr, 0, 0) == 0 ? orca::again() : orca::done(); }
};

}  // namespace

ORCA_COMPONENT(Stick, "test.Stick")
ORCA_STEADY_CLOCK_ONLY("reads a joystick")
