// SPDX-License-Identifier: GPL-3.0-or-later
// A static variable whose constructor exits.
#include <cstdlib>

#include "orca/component.hpp"

namespace {

struct Leave {
  Leave() { std::exit(4); }
} leave;

}  // namespace

namespace {

class Never final : public orca::Component {
 public:
  using Component::Component;
  orca::Outcome work() override { return orca::done(); }
};

}  // namespace

ORCA_COMPONENT(Never, "test.StaticExits")
