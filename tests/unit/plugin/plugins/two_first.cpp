// SPDX-License-Identifier: GPL-3.0-or-later
// One of two types of one plugin: a component.
#include "orca/component.hpp"

namespace {

class Two final : public orca::Component {
 public:
  using Component::Component;
  orca::Outcome work() override { return orca::done(); }

 private:
  orca::Param<std::int64_t> laps_{*this, "laps", 3, {.min = 1.0, .max = 9.0, .text = "How many."}};
};

}  // namespace

ORCA_COMPONENT(Two, "test.First")
