// SPDX-License-Identifier: GPL-3.0-or-later
// Has a function of its own called when the process ends.
#include <cstdlib>

#include "orca/component.hpp"

namespace {

class Leaver final : public orca::Component {
 public:
  explicit Leaver(orca::ComponentHost& host) : Component(host) {
    on_exit([](int /*status*/, void* /*nothing*/) {}, nullptr);
  }
  orca::Outcome work() override { return orca::done(); }
};

}  // namespace

ORCA_COMPONENT(Leaver, "test.Leaver")
