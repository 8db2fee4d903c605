// SPDX-License-Identifier: GPL-3.0-or-later
// A constructor that does more than declare.
#include "orca/component.hpp"

namespace {

class AsksTime final : public orca::Component {
 public:
  explicit AsksTime(orca::ComponentHost& host) : Component(host), started_(now()) {}
  orca::Outcome work() override { return now() > started_ ? orca::done() : orca::again(); }

 private:
  orca::TimePoint started_;
};

}  // namespace

ORCA_COMPONENT(AsksTime, "test.AsksTime")
