// SPDX-License-Identifier: GPL-3.0-or-later
// A plugin that says itself that virtual time is nothing for it.
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
