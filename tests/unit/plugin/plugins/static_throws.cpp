// SPDX-License-Identifier: GPL-3.0-or-later
// A static variable whose constructor throws.
#include <stdexcept>

#include "orca/component.hpp"

namespace {

struct Smoke {
  Smoke() { throw std::runtime_error("the static initialisation smokes"); }
} smoke;

}  // namespace

namespace {

class Never final : public orca::Component {
 public:
  using Component::Component;
  orca::Outcome work() override { return orca::done(); }
};

}  // namespace

ORCA_COMPONENT(Never, "test.StaticThrows")
