// SPDX-License-Identifier: GPL-3.0-or-later
#include "orca/component.hpp"

namespace {

/// Does nothing, in as few bytes as possible.
class Small final : public orca::Component {
 public:
  using Component::Component;
  orca::Outcome work() override { return orca::done(); }
};

}  // namespace

ORCA_COMPONENT(Small, "test.Small")
