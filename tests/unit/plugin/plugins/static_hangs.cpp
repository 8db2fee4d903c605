// SPDX-License-Identifier: GPL-3.0-or-later
// A static variable whose constructor never returns.
#include "orca/component.hpp"

namespace {

volatile bool forever = true;

struct Hang {
  Hang() {
    while (forever) {
    }
  }
} hang;

}  // namespace

namespace {

class Never final : public orca::Component {
 public:
  using Component::Component;
  orca::Outcome work() override { return orca::done(); }
};

}  // namespace

ORCA_COMPONENT(Never, "test.StaticHangs")
