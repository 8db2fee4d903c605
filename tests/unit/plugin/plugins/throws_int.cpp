// SPDX-License-Identifier: GPL-3.0-or-later
// A constructor that throws something other than a std::exception.
#include "orca/component.hpp"

namespace {

class ThrowsInt final : public orca::Component {
 public:
  explicit ThrowsInt(orca::ComponentHost& host) : Component(host) { throw 7; }
  orca::Outcome work() override { return orca::done(); }
};

}  // namespace

ORCA_COMPONENT(ThrowsInt, "test.ThrowsInt")
