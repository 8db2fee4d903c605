// SPDX-License-Identifier: GPL-3.0-or-later
#include "orca/component.hpp"
#include "orca/idl/motion.hpp"

namespace {

/// A behaviour that wishes to drive on, in a mission of its own.
class Wisher final : public orca::Component {
 public:
  explicit Wisher(orca::ComponentHost& host) : Component(host) { lap_every(std::chrono::milliseconds(100)); }

 private:
  orca::Outcome work() override {
    auto wish = orca::head(0.0, 0.3, *weight_);
    wish->mission(static_cast<std::uint64_t>(*mission_));
    motion_.push(std::move(wish));
    return orca::again();
  }

  orca::PushServer<orca::idl::MotionCommand> motion_{*this, "motion"};
  orca::Param<double> weight_{*this, "weight", 1.0};
  orca::Param<std::int64_t> mission_{*this, "mission", 0};
};

}  // namespace

ORCA_COMPONENT(Wisher, "test.Wisher")
