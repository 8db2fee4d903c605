// SPDX-License-Identifier: GPL-3.0-or-later
// A plugin that may use one thing in virtual time, and uses another one.
#include <poll.h>

#include <cstdlib>

#include "orca/component.hpp"

namespace {

class Asker final : public orca::Component {
 public:
  using Component::Component;
  orca::Outcome work() override { return poll(nullptr, 0, rand() % 2) == 0 ? orca::again() : orca::done(); }
};

}  // namespace

ORCA_COMPONENT(Asker, "test.Asker")
ORCA_ALLOW_IN_VIRTUAL_TIME("poll", "it waits for a millisecond at most")
