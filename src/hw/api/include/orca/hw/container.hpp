// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "orca/base/result.hpp"
#include "orca/base/strand.hpp"
#include "orca/component/host.hpp"
#include "orca/component/param.hpp"
#include "orca/geometry/pose2.hpp"
#include "orca/hw/drawable.hpp"
#include "orca/hw/endpoint_list.hpp"
#include "orca/hw/hardware_state.hpp"
#include "orca/hw/line_counts.hpp"
#include "orca/hw/surroundings.hpp"
#include "orca/idl/hardware.hpp"
#include "orca/idl/sensing.hpp"

namespace orca::hw {

class HardwareLifecycle;
class HardwareLoop;

/// The services that a process offers to a hardware container.
class HardwareHost : public PluginHost {
 public:
  /// Returns the seed of the run, for things that belong to no single stream: the simulated world.
  [[nodiscard]] virtual std::uint64_t run_seed() const = 0;
  /// Reports to whoever runs the system that a robot has touched something. The framework stamps the header.
  virtual void report(const idl::Contact& contact) = 0;
  /// Reports a change of the container's state, for traces.
  virtual void state_changed(HardwareState state) = 0;
  /// Reports that the base is held, and not by order of the process: a person must do something.
  /// @param reason  nothing: it is so no more.
  virtual void held(const std::optional<std::string>& reason) = 0;
  /// Reports that the container's strand has done something and is about to wait.
  virtual void pausing() = 0;
  [[nodiscard]] virtual Executive& executive() = 0;
  /// Reports where a robot truly is, which only a simulator knows. Whoever runs the system compares it with what components say.
  /// @param X_WR  of the robot in the frame of the world.
  virtual void truly_at(const std::string& /*robot*/, const Pose2& /*X_WR*/) {}
};

/// What a driver does with its device when the container asks for it. All of it runs on the container's own strand and never
/// overlaps; none of it waits for the device. An error, and an exception, is a fault of the device with that text.
class DriverFunctions {
 public:
  DriverFunctions() = default;
  DriverFunctions(const DriverFunctions&) = delete;
  DriverFunctions& operator=(const DriverFunctions&) = delete;

 protected:
  ~DriverFunctions() = default;

  /// Opens the port.
  virtual Status open() { return ok(); }
  /// Finds out what is there. Called after open() and then at next_poll() and when there is input, until it knows. It does not
  /// wait.
  /// @return whether it knows; an error with advice if there is no hope.
  virtual Result<bool> probe() { return true; }
  /// Returns whether a device that has worked and failed may work again when it is opened anew, as one that hangs on a cable
  /// may. Its base then stands until an operator lets it move.
  [[nodiscard]] virtual bool recovers() const { return false; }
  /// Returns the descriptor at which the device's bytes arrive; -1: none, or not now. The container looks at it before each
  /// wait.
  [[nodiscard]] virtual int descriptor() const { return -1; }
  /// Returns whether input wakes the container, which then calls poll(): at the descriptor, or as the driver calls wake().
  [[nodiscard]] virtual bool hears_input() const { return descriptor() >= 0; }
  /// Returns after how long without heard() the device has failed [s].
  [[nodiscard]] virtual Duration longest_silence() const { return Duration::max(); }
  /// Returns what was read from the line since open().
  [[nodiscard]] virtual LineCounts counts() const { return {}; }
  /// Begins to measure; somebody uses the device from now on. It gives no power to motors after a fault.
  virtual Status start() { return ok(); }
  /// Ends that. The motors have been told to stand.
  virtual void stop() {}
  /// Closes the device. Also called after open() has failed.
  virtual void close() {}
  /// Reads the device and publishes readings. Called at next_poll() while ready or active, and whenever descriptor() may have
  /// input (thesis 10.2, handleInput). It does not wait.
  virtual Status poll() = 0;
  [[nodiscard]] virtual TimePoint next_poll() const = 0;
  /// Carries out a set-point. Where it is to stop at once, with the emergency stop of the device if it has one that does
  /// not switch the motors off.
  virtual Status drive(const DriveSetpoint& setpoint) = 0;
};

/// All hardware behind one port or bus. It opens, starts, stops and closes the device, and has endpoints: sensors, the motion
/// of a base, and other actuators (thesis 10.2, Fig. 10.1-10.2). A server component (RobotBaseServer, LaserServer) wraps
/// it, through a HardwareSeat.
///
/// A driver overrides the DriverFunctions. The constructor only declares parameters. prepare() declares endpoints from them
/// and opens nothing, so a graph can be checked without the device.
///
/// Thread contract: the public functions from any strand.
class HardwareContainer : public DriverFunctions, public EndpointList {
 public:
  explicit HardwareContainer(HardwareHost& host);
  /// May throw, because a plugin author's destructor may throw; the runtime contains it.
  virtual ~HardwareContainer() noexcept(false);
  HardwareContainer(const HardwareContainer&) = delete;
  HardwareContainer& operator=(const HardwareContainer&) = delete;

  void declare_param(ParamDeclaration declaration) { host_.declare_param(std::move(declaration)); }

  /// Reads what the parameters name, and declares the endpoints.
  /// @return the faults that were found, and what the checker should warn about (HardwareFault::only_warns).
  virtual std::vector<HardwareFault> prepare() = 0;

  /// Compares this hardware with one of the same type that the graph names earlier, so that a graph can be
  /// checked for what the two cannot have both, and for what they can share only within one process
  /// (HardwareFault::if_apart). That no two of whatever type have one line_name() is checked without it.
  /// @pre  both were prepared, without a fault.
  /// @return the faults, of this hardware's parameters; empty: none.
  [[nodiscard]] virtual std::vector<HardwareFault> conflicts_with(
      const HardwareContainer& /*earlier*/) const {
    return {};
  }

  /// Returns what this hardware is, for clients that ask by Query.
  [[nodiscard]] virtual idl::Robot description() const = 0;
  /// Returns the parameters with which a graph would suit the device better, with their values, as far as the device has told: its
  /// model. Empty if the parameters suit it.
  /// @pre  state() is Ready.
  [[nodiscard]] virtual std::vector<std::pair<std::string, std::string>> learned() const { return {}; }
  /// Returns the line to the device, as its parameter `device` in the graph names it; empty: it has none.
  [[nodiscard]] const std::string& line_name() const { return line_name_; }
  /// Returns what was counted on that line, and the state of the device.
  [[nodiscard]] idl::DeviceStatistics statistics() const;
  /// Returns the interface that draws this hardware; null for real hardware.
  [[nodiscard]] virtual Drawable* drawable() { return nullptr; }
  /// Returns the world around this hardware; null for real hardware.
  [[nodiscard]] virtual Surroundings* surroundings() { return nullptr; }

  /// Starts the container's strand, which opens the device; again if it was shut down and has ended, closed.
  void run();
  /// Stops the motors, closes the device and ends the strand.
  void shut_down();
  /// Waits until the strand has ended, at most until the deadline.
  /// @return true if the strand has ended by the deadline, or has never run.
  [[nodiscard]] bool join_until(TimePoint deadline);

  /// Adds or removes a user: the device is started for the first and stopped after the last.
  void acquire();
  void release();

  /// Takes a command for the motion endpoint, to be carried out at once.
  /// @tparam Command  what MotionHW takes: idl::MotionCommand, HolonomicVelocity.
  /// @errors  failed_precondition without a motion endpoint, unavailable unless active, and those of
  /// MotionHW::command().
  template <class Command>
  Status command(const Command& command) {
    if (Status able = check_active(); !able.ok()) return able;
    const Status taken = motion()->command(command, host_.now());
    if (taken.ok()) wake();
    return taken;
  }
  /// Takes a command for one of the actuators, to be carried out at once, or as soon as the hardware is active.
  /// @errors  those of ActuatorEndpoint::command().
  Status command(ActuatorEndpoint& actuator, ObjectRef command);
  /// Refuses commands to move and stops what moves, with the emergency stop of a base, until let_go(), by order of the process.
  /// @param reason  for people, as the error of a refused command gives it.
  void hold(const std::string& reason);
  /// Returns whether anything was held.
  bool let_go();

  [[nodiscard]] HardwareState state() const;
  /// Returns why the state is Fault or Backoff, or was so last.
  [[nodiscard]] std::string fault() const;
  /// Returns whether the device has failed and will not be opened again.
  [[nodiscard]] bool is_lost() const;
  /// Wakes `strand` at every change of state.
  /// @param on  false: no more. It is not woken once this has returned.
  void watch(Strand& strand, bool on = true);

 protected:
  void set_line_name(std::string name) { line_name_ = std::move(name); }

  /// Notes that the device has said something that makes sense.
  void heard();
  /// The same. @param sent  when its first byte left the device.
  void heard(TimePoint sent);

  [[nodiscard]] HardwareHost& host() const { return host_; }
  /// Lets the container's strand look again at what is to be done.
  /// @thread  any.
  void wake();

 private:
  friend class HardwareLifecycle;
  friend class HardwareLoop;

  [[nodiscard]] Status check_active() const;

  HardwareHost& host_;
  std::string line_name_;
  // Everything that changes while the container runs; drivers are compiled without knowing it.
  const std::unique_ptr<HardwareLoop> loop_;
};

}  // namespace orca::hw
