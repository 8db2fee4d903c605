// SPDX-License-Identifier: GPL-3.0-or-later
#include "orca/component.hpp"
#include "throw_something.hpp"

namespace {

class ThrowsIntInConstructor final : public orca::Component {
 public:
  explicit ThrowsIntInConstructor(orca::ComponentHost& host) : Component(host) {
    orca::test::throw_something("int");
  }

 private:
  orca::Outcome work() override { return orca::done(); }
};

}  // namespace

ORCA_COMPONENT(ThrowsIntInConstructor, "test.ThrowsIntInConstructor")
