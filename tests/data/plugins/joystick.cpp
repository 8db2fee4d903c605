// SPDX-License-Identifier: GPL-3.0-or-later
#include "orca/component.hpp"

namespace {

/// Would read a joystick, so it says that virtual time is nothing for it.
class Joystick final : public orca::Component {
 public:
  using Component::Component;

 private:
  orca::Outcome work() override { return orca::done(); }
};

}  // namespace

ORCA_COMPONENT(Joystick, "test.Joystick")
ORCA_STEADY_CLOCK_ONLY("a joystick moves in real time")
