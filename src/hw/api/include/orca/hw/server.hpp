// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <functional>
#include <memory>
#include <set>
#include <string>
#include <vector>

#include "orca/component/component.hpp"
#include "orca/hw/seat.hpp"
#include "orca/idl/hardware.hpp"
#include "orca/idl/motion.hpp"
#include "orca/idl/system.hpp"
#include "orca/patterns/push.hpp"
#include "orca/patterns/query.hpp"
#include "orca/patterns/send.hpp"

namespace orca::hw {

/// A component that wraps a hardware container, whatever endpoints it has (thesis 10.2-10.3). Each sensor of
/// the chosen source becomes a Push and a Query port named after its object type (`OdometryPush`,
/// `OdometryQuery`); where several devices deliver one type, their names come first (`rear_LaserRangeReadingsPush`). The motion of a base becomes a Send port `MotionCommandSend`, and
/// `HolonomicVelocitySend` if it moves sideways; the former takes these velocities as well. Each other actuator becomes a Send port named after the object type of its
/// commands (`TurretCommandSend`, `GripperCommandSend`). A device that hangs on a line has `DeviceStatisticsQuery`. A new type
/// of sensor or actuator needs no change here. A Query is answered with the latest reading, unless it was sensed before the time that the client
/// asks for: then with an error, unavailable. RobotBaseServer, LaserServer and TruthLocalizer add a few lines of
/// their own.
///
/// A base that its bumpers or its motors hinder is the alarm BUMPER_TOUCHED or MOTOR_STALLED of this component, until it is so no more.
///
/// The hardware is active while somebody subscribes, for a moment after a motion command, and while a query
/// waits.
///
/// Thread contract: its own strand, as for every component.
class HardwareServer : public Component {
 public:
  /// @param source  the source whose sensors it offers.
  /// @param only    the type of the objects that the offered sensors deliver; null: any.
  HardwareServer(ComponentHost& host, Source source, const ObjectType* only = nullptr);
  ~HardwareServer() override;

  Status configure() override;
  Status start() override;
  Outcome work() override;
  void stop() override;

 protected:
  /// Returns the hardware that the graph binds to this component; null while a type is described without
  /// hardware.
  [[nodiscard]] HardwareSeat* seat() const { return seat_; }
  /// Offers the commands that the base can carry out, if there is one, and those of the other actuators.
  void offer_motion();
  /// Changes a reading before anybody gets it.
  /// @thread  the driver's strand; what it uses must be constant while the component works.
  virtual void amend(ObjectLoan& /*reading*/) const {}

 private:
  class SensorPorts;

  Result<Loan<idl::DeviceStatistics>> on_statistics(const ObjectPtr<idl::Ask>& ask);
  Status on_motion(const ObjectPtr<idl::MotionCommand>& command);
  static bool is_stop(const idl::HolonomicVelocity& velocity);
  Status on_velocity(const ObjectPtr<idl::HolonomicVelocity>& velocity);
  Status on_actuator(const HardwareSeat::Actuator& actuator, const ObjectRef& command);
  template <class Command>
  Status carry_out(const ObjectPtr<Command>& command, bool stands);
  void offer_base();
  Status told_once(const Status& taken);
  template <class Command>
  void ask_about(const Command& command);
  void carry_out_waiting_command();
  void release_idle_motion();
  void report_hindrances();

  HardwareSeat* const seat_;
  bool watches_ = false;  // whether the seat wakes the strand
  std::vector<std::unique_ptr<SensorPorts>> sensors_;
  std::unique_ptr<QueryServer<idl::Ask, idl::DeviceStatistics>> statistics_;
  std::unique_ptr<SendServer<idl::MotionCommand>> motion_;
  std::unique_ptr<SendServer<idl::HolonomicVelocity>> velocity_;
  std::vector<std::unique_ptr<SendServerHandle>> actuators_;
  std::function<Status()> waiting_command_;  // came while the hardware was idle
  TimePoint last_command_{};
  std::string obstruction_;        // why the base did not carry out the last command
  std::set<std::string> doubted_;  // senders of commands that no robot can carry out
};

}  // namespace orca::hw
