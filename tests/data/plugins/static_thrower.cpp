// SPDX-License-Identifier: GPL-3.0-or-later
#include <stdexcept>

#include "orca/component.hpp"

namespace {

struct Smoke {
  Smoke() { throw std::runtime_error("the static initialisation smokes"); }
} smoke;

/// Is never loaded, because the static initialisation of its plugin throws.
class StaticThrower final : public orca::Component {
 public:
  using Component::Component;

 private:
  orca::Outcome work() override { return orca::done(); }
};

}  // namespace

ORCA_COMPONENT(StaticThrower, "test.StaticThrower")
