// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "orca/component/component.hpp"
#include "orca/hw/container.hpp"
#include "orca/idl/motion.hpp"
#include "orca/patterns/push.hpp"
#include "orca/patterns/query.hpp"
#include "orca/patterns/send.hpp"

namespace orca::hw {

/// Wraps a hardware container in a component, whatever endpoints it has (thesis 10.2-10.3): each sensor of
/// the chosen source becomes a Push and a Query port named after its object type (`OdometryPush`,
/// `OdometryQuery`), the motion endpoint a Send port `MotionCommandSend`, and what only some bases can do a
/// port on those bases alone: `HolonomicVelocitySend` on one that moves sideways, `TurretCommandSend` on one
/// with a turret. A new sensor type needs no change here. RobotBaseServer, LaserServer and TruthLocalizer are
/// this with a few lines of their own.
///
/// The hardware is active while somebody subscribes, for a moment after a motion command, and while a query
/// waits.
///
/// Thread contract: as every component, its own strand.
class HardwareServer : public Component {
 public:
  /// @param source  which of the container's sensors to offer.
  /// @param only    of these, the ones that deliver objects of this type; null: all.
  HardwareServer(ComponentHost& host, Source source, const ObjectType* only = nullptr);
  ~HardwareServer() override;

  Status configure() override;
  Status start() override;
  Outcome work() override;
  void stop() override;

 protected:
  /// The container that the graph binds to this component; null while a type is described without hardware.
  [[nodiscard]] HardwareContainer* container() const { return container_; }
  /// Offers what the container's motion endpoint can do, if it has one.
  void offer_motion();

 private:
  class SensorPorts;

  Status on_motion(const ObjectPtr<idl::MotionCommand>& command);
  Status on_velocity(const ObjectPtr<idl::HolonomicVelocity>& velocity);
  Status on_turret(const ObjectPtr<idl::TurretCommand>& turret);
  template <class Command>
  Status carry_out(const ObjectPtr<Command>& command, bool stands);
  void carry_out_waiting_command();
  void release_idle_motion();

  HardwareContainer* const container_;
  std::vector<std::unique_ptr<SensorPorts>> sensors_;
  std::unique_ptr<SendServer<idl::MotionCommand>> motion_;
  std::unique_ptr<SendServer<idl::HolonomicVelocity>> velocity_;
  std::unique_ptr<SendServer<idl::TurretCommand>> turret_;
  std::function<Status()> waiting_command_;  // came while the hardware was idle
  TimePoint last_command_{};
};

}  // namespace orca::hw
