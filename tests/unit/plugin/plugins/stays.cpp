// SPDX-License-Identifier: GPL-3.0-or-later
// Linked so that it can never be unloaded.
#include "orca/component.hpp"

namespace {

class Stays final : public orca::Component {
 public:
  using Component::Component;
  orca::Outcome work() override { return orca::done(); }
};

}  // namespace

ORCA_COMPONENT(Stays, "test.Stays")
