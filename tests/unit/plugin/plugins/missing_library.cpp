// SPDX-License-Identifier: GPL-3.0-or-later
// A plugin that needs a library that is not there.
#include "orca/component.hpp"

int gone();

namespace {

class Misses final : public orca::Component {
 public:
  using Component::Component;
  orca::Outcome work() override { return gone() > 0 ? orca::again() : orca::done(); }
};

}  // namespace

ORCA_COMPONENT(Misses, "test.Misses")
