// SPDX-License-Identifier: GPL-3.0-or-later
// A constructor that reads a parameter, of which only the default is there yet.
#include "orca/component.hpp"

namespace {

class ReadsParam final : public orca::Component {
 public:
  using Component::Component;
  orca::Outcome work() override { return twice_ > 1.0 ? orca::done() : orca::again(); }

 private:
  orca::Param<double> reach_{*this, "reach", 0.5, {.unit = "m", .min = 0.0}};
  double twice_ = 2.0 * *reach_;
};

}  // namespace

ORCA_COMPONENT(ReadsParam, "test.ReadsParam")
