// SPDX-License-Identifier: GPL-3.0-or-later
#include "orca/component.hpp"
#include "orca/idl/motion.hpp"
#include "orca/idl/sensing.hpp"

namespace {

/// Steps half a metre to the left, as only a holonomic base can, and is done.
class Sidestep final : public orca::Component {
 public:
  explicit Sidestep(orca::ComponentHost& host) : Component(host) { lap_every(std::chrono::milliseconds(50)); }

 private:
  orca::Status start() override {
    from_ = *pose_.get_update();
    began_ = now();
    return orca::ok();
  }

  orca::Outcome work() override {
    const orca::ObjectPtr<orca::idl::RobotPose> pose = pose_.get_update();
    const bool there = pose->y() - from_.y() > 0.5;
    auto velocity = orca::make_object<orca::idl::HolonomicVelocity>();
    velocity->left(there ? 0.0 : 0.3);
    if (const orca::Status sent = base_.send(std::move(velocity)); !sent.ok())
      return orca::failed(sent.error().text());
    if (now() - began_ > std::chrono::seconds(10)) return orca::failed("it does not get anywhere");
    if (!there) return orca::again();
    const bool straight = std::abs(pose->x() - from_.x()) < 0.01 && pose->sideways_velocity() > 0.2;
    return straight ? orca::done() : orca::failed("it did not go straight to the left");
  }

  orca::PushProxy<orca::idl::RobotPose> pose_{*this, "pose"};
  orca::SendProxy<orca::idl::HolonomicVelocity> base_{*this, "base"};
  orca::idl::RobotPose from_;
  orca::TimePoint began_{};
};

}  // namespace

ORCA_COMPONENT(Sidestep, "test.Sidestep")
