// SPDX-License-Identifier: GPL-3.0-or-later
// A plugin that uses a symbol that no library provides. The recipe, which would refuse to link it, is not used.
#include "orca/component.hpp"

namespace orca::test {
double beyond_all_libraries(double value);
}

namespace {

class Undefined final : public orca::Component {
 public:
  using Component::Component;
  orca::Outcome work() override {
    return orca::test::beyond_all_libraries(1.0) > 0.0 ? orca::again() : orca::done();
  }
};

}  // namespace

ORCA_COMPONENT(Undefined, "test.Undefined")
