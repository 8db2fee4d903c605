// SPDX-License-Identifier: GPL-3.0-or-later
#include "orca/component.hpp"
#include "throw_something.hpp"

namespace {

class ThrowsInConstructor final : public orca::Component {
 public:
  explicit ThrowsInConstructor(orca::ComponentHost& host) : Component(host) {
    orca::test::throw_something("exception");
  }

 private:
  orca::Outcome work() override { return orca::done(); }
};

}  // namespace

ORCA_COMPONENT(ThrowsInConstructor, "test.ThrowsInConstructor")
