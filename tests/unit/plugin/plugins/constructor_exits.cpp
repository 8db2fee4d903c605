// SPDX-License-Identifier: GPL-3.0-or-later
// A component whose constructor ends the process after it has declared everything.
#include <cstdlib>

#include "orca/component.hpp"

namespace {

class Leaves final : public orca::Component {
 public:
  explicit Leaves(orca::ComponentHost& host) : Component(host) {
    host.set_default_trigger({});
    std::_Exit(5);
  }
  orca::Outcome work() override { return orca::done(); }
};

}  // namespace

ORCA_COMPONENT(Leaves, "test.Leaves")
