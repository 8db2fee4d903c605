// SPDX-License-Identifier: GPL-3.0-or-later
// A static variable whose constructor crashes.
#include "orca/component.hpp"

namespace {

int* volatile nowhere = nullptr;

struct Crash {
  Crash() { *nowhere = 1; }
} crash;

}  // namespace

namespace {

class Never final : public orca::Component {
 public:
  using Component::Component;
  orca::Outcome work() override { return orca::done(); }
};

}  // namespace

ORCA_COMPONENT(Never, "test.StaticCrashes")
