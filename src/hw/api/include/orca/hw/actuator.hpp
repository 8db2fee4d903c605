// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <functional>
#include <mutex>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "orca/base/result.hpp"
#include "orca/idl/motion.hpp"
#include "orca/idl/object.hpp"

namespace orca::hw {

/// Something of a hardware container that moves besides its base, whatever its type: a turret, a gripper, an arm (thesis 10.2,
/// Fig. 10.6). The server that wraps the container turns it into a Send port named after the object type of its commands and,
/// where several devices take that type, the device.
///
/// A command holds until the next one. It never becomes too old, because it does not move the robot. One that comes while the
/// hardware is idle waits until it is active.
///
/// Thread contract: carry_out() and forget() from the container's strand; the rest from any strand.
class ActuatorEndpoint {
 public:
  /// @param device  its name, where the container has several actuators that take this type; empty: it has only this one.
  ///                Letters, digits and _, since the name of its port begins with it.
  ActuatorEndpoint(const ObjectType& type, std::string device) : type_(type), device_(std::move(device)) {}
  ActuatorEndpoint(const ActuatorEndpoint&) = delete;
  ActuatorEndpoint& operator=(const ActuatorEndpoint&) = delete;

  /// Returns the type of its commands.
  [[nodiscard]] const ObjectType& type() const { return type_; }
  /// Returns its name among several that take this type; empty: it is the only one.
  [[nodiscard]] const std::string& device() const { return device_; }
  /// Returns what the name of its port begins with: TurretCommand; of several: left_GripperCommand.
  [[nodiscard]] std::string port_stem() const;

  /// Takes a command. Commands are carried out in the order in which they came.
  /// @pre  the command is of type() or derived from it.
  /// @errors  invalid_argument if no such device can carry it out; unavailable, with the reason, while it is held or too many
  /// commands wait.
  Status command(ObjectRef command);

  /// Stops it where it is if the driver can do that, forgets the commands that wait, and refuses others until let_go(): an emergency
  /// stop.
  /// @param reason  for people, as the error of a refused command gives it.
  void hold(const std::string& reason);
  /// Returns whether it was held.
  bool let_go();

  /// Lets the device do what was asked for since the last call.
  /// @errors  those of the device.
  Status carry_out();
  /// Forgets the commands that wait. Called when the device has failed.
  void forget();

 protected:
  ~ActuatorEndpoint() = default;

  [[nodiscard]] virtual Status check(const ObjectRef& command) const = 0;
  virtual Status act(const ObjectRef& command) = 0;
  virtual Status halt() = 0;

 private:
  const ObjectType& type_;
  const std::string device_;
  std::mutex mutex_;
  std::vector<ObjectRef> waiting_;
  bool halts_ = false;               // the device has not been told yet to stop
  std::optional<std::string> held_;  // why, while it is held
};

/// An actuator endpoint that takes commands of type T, for which there is a check_command().
template <class T>
class ActuatorHW final : public ActuatorEndpoint {
 public:
  /// What the driver does with the device, on the container's strand, without waiting. An error is a fault of the device.
  struct Driver {
    std::function<Status(const T&)> act;
    std::function<Status()> halt{};  ///< Stops it where it is; empty: it does not stop on its way.
  };

  explicit ActuatorHW(Driver driver, std::string device = "")
      : ActuatorEndpoint(object_type<T>(), std::move(device)), driver_(std::move(driver)) {}

 private:
  [[nodiscard]] Status check(const ObjectRef& command) const override {
    return check_command(*object_cast<T>(command));
  }
  Status act(const ObjectRef& command) override { return driver_.act(*object_cast<T>(command)); }
  Status halt() override { return driver_.halt ? driver_.halt() : ok(); }

  const Driver driver_;
};

}  // namespace orca::hw
