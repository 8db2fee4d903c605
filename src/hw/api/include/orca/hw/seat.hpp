// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <functional>
#include <mutex>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "orca/base/result.hpp"
#include "orca/base/strand.hpp"
#include "orca/component/device.hpp"
#include "orca/hw/container.hpp"
#include "orca/hw/endpoints.hpp"
#include "orca/hw/hardware_state.hpp"
#include "orca/idl/hardware.hpp"

namespace orca::hw {

/// The place of one driver in a system, as the servers on it see it. It stays when another driver takes the place: to
/// the servers that is a pause, in which no readings come and every command is refused.
///
/// Thread contract: any strand.
class HardwareSeat final : public Device {
 public:
  /// A sensor, whichever driver reads it.
  struct Sensor {
    const ObjectType* type;
    Source source;
    std::string port_stem;  ///< As SensorEndpoint::port_stem(); no other sensor of the source has it.
    Duration period;        ///< [s] Between two readings.
  };
  /// Something that moves besides a base, whichever driver moves it.
  struct Actuator {
    const ObjectType* type;  ///< Of its commands.
    std::string port_stem;   ///< As ActuatorEndpoint::port_stem(); no other actuator has it.
  };

  /// @param driver       prepared before a server is constructed. Outlives the object, or its time in the seat.
  /// @param description  of the driver; nothing: it is asked when somebody wants to know.
  explicit HardwareSeat(HardwareContainer& driver, std::optional<idl::Robot> description = std::nullopt)
      : driver_(&driver), description_(std::move(description)) {}

  // For servers; most functions are those of the driver's container.

  [[nodiscard]] std::vector<Sensor> sensors() const;
  /// Sets where the readings of a sensor go for `owner`, as SensorEndpoint::set_sink().
  void set_sink(const Sensor& sensor, const void* owner, SensorEndpoint::Sink sink);
  /// Returns the last reading of a sensor since the hardware was started, or null.
  [[nodiscard]] ObjectRef latest(const Sensor& sensor) const;

  [[nodiscard]] std::vector<Actuator> actuators() const;
  /// Takes a command for an actuator, as HardwareContainer::command().
  /// @errors  the same; unavailable during a pause.
  Status command(const Actuator& actuator, ObjectRef command);

  /// Lets `act` look at the world around the hardware, or change it.
  /// @errors  unimplemented: the hardware is real, and has none. unavailable during a pause, and before the hardware is Ready.
  ///          Those of `act`.
  Status in_surroundings(const std::function<Status(Surroundings&)>& act) const;

  /// Returns the limits of the base; nothing if it has none.
  [[nodiscard]] std::optional<DriveLimits> limits() const;
  /// Returns for how long a command holds [s]. @pre  there is a base.
  [[nodiscard]] Duration max_command_age() const;
  /// Returns why the base is hindered, as MotionHW::take_hindrance(); nothing during a pause.  @pre  there is a base.
  [[nodiscard]] std::optional<std::string> take_hindrance(Hindrance by) const;
  /// Returns whether the hardware hangs on a line.
  [[nodiscard]] bool has_line() const;
  /// Returns whether it has a base or other actuators.
  [[nodiscard]] bool moves() const;
  /// Returns what was counted on that line.
  [[nodiscard]] idl::DeviceStatistics statistics() const;
  /// Returns what the hardware is.
  [[nodiscard]] idl::Robot description() const;

  void acquire();
  void release();

  /// Takes a command for the base, as HardwareContainer::command().
  /// @errors  the same; unavailable during a pause.
  template <class Command>
  Status command(const Command& command) {
    const std::lock_guard lock(mutex_);
    if (Status open = check_open(); !open.ok()) return open;
    return driver_->command(command);
  }

  /// Returns the driver's state; during a pause the one before it.
  [[nodiscard]] HardwareState state() const;
  /// Returns why the device has failed.
  [[nodiscard]] std::string fault() const;
  /// Returns whether the device has failed and will not be opened again.
  [[nodiscard]] bool is_lost() const;
  /// Wakes `strand` at every change of state.
  /// @param on  false: no more. It is not woken once this has returned.
  void watch(Strand& strand, bool on = true);

  // For the process.

  /// Stops what moves and refuses commands to move, until let_go(), whichever driver is there.
  /// @param reason  for people: "emergency stop".
  void hold(const std::string& reason);
  /// Lets it move again, also if it is held because its device had failed. Returns whether it was held.
  bool let_go();

  /// Begins a pause: stops what moves at once, and frees the driver of its users. The driver may then be closed.
  /// @param reason  for people: "its driver is being exchanged".
  void pause(const std::string& reason);
  /// Ends the pause with a driver, the same or another one with the same sensors. It gets all users.
  void resume(HardwareContainer& driver, const idl::Robot& description);
  /// Makes the pause last for ever, with the state Fault.
  void give_up(const std::string& reason);
  /// Returns whether anybody uses the hardware.
  [[nodiscard]] bool is_used() const;

 private:
  struct Pause {
    HardwareState state;  // that the servers see
    std::string reason;
  };
  struct Listener {
    Sensor sensor;
    const void* owner;
    SensorEndpoint::Sink sink;
  };

  // All of these: @pre  mutex_ is held.
  [[nodiscard]] Status check_open() const;
  void take_over(HardwareContainer& driver);
  void wake_watchers() const;

  mutable std::mutex mutex_;
  HardwareContainer* driver_;
  mutable std::optional<idl::Robot> description_;  // of this driver
  std::vector<Listener> listeners_;
  std::vector<Strand*> watchers_;
  int users_ = 0;
  std::optional<std::string> held_;  // why, while the process holds it
  std::optional<Pause> pause_;
};

}  // namespace orca::hw
