// SPDX-License-Identifier: GPL-3.0-or-later
// Another class with the type of two_first.cpp, as copied and not renamed.
#include "orca/component.hpp"

namespace {

class Again final : public orca::Component {
 public:
  using Component::Component;
  orca::Outcome work() override { return orca::again(); }
};

}  // namespace

ORCA_COMPONENT(Again, "test.First")
