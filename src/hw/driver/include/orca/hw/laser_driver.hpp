// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "orca/hw/laser_place.hpp"
#include "orca/hw/line_driver.hpp"
#include "orca/idl/sensing.hpp"

namespace orca::hw {

/// A driver of a laser at the end of one line: where it sits, its scans as an endpoint, and its description, which all lasers have. A
/// driver adds a session, and look(), which publishes what that brings.
///
/// Thread contract: as LineDriver.
class LaserDriver : public LineDriver {
 public:
  std::vector<HardwareFault> prepare() final;
  [[nodiscard]] idl::Robot description() const final;

 protected:
  /// What is the same for all lasers of a driver. A plain value.
  struct Kind {
    std::string vendor;
    std::string model;
    std::string direction = "its middle beam";  ///< What of the laser looks ahead, for people.
  };
  /// The scans as the parameters say them. Angles are the laser's own: counter-clockwise when it does not hang upside down. A plain value.
  struct Scans {
    std::size_t beams = 0;
    double first_angle = 0.0;  ///< [rad] Of the first beam, 0 ahead.
    double increment = 0.0;    ///< [rad] From beam to beam.
    double min_range = 0.0;    ///< [m]
    double max_range = 0.0;    ///< [m]
    Duration period{0};        ///< From scan to scan.
  };

  /// @param first  as that of LineDriver.
  LaserDriver(HardwareHost& host, const link::Line& first, const Kind& kind);

  /// Finds what is wrong with the parameters of the driver.
  virtual void check(std::vector<HardwareFault>& /*faults*/) {}
  /// Returns how it scans. @pre  the parameters have no fault.
  [[nodiscard]] virtual Scans scans() const = 0;
  /// Reads the line and publishes what it brings. Called when something has come, and now and then. It does not wait.
  virtual Status look(TimePoint now) = 0;

  /// Publishes a scan. @param ranges  [m] of all beams; infinite: nothing is there.
  /// @param stamp  when the first beam was measured. @param time_increment  [s] from beam to beam; 0: they are not measured in their order.
  void publish(std::span<const double> ranges, TimePoint stamp, double time_increment);

 private:
  Status poll() final;
  [[nodiscard]] TimePoint next_step() const final;
  [[nodiscard]] TimePoint next_turn() const final;
  Status drive(const DriveSetpoint& setpoint) final;

  const Kind kind_;
  Param<std::string> name_;
  LaserPlace place_;
  std::optional<SensorHW<idl::LaserRangeReadings>> endpoint_;
  TimePoint looked_{};
};

}  // namespace orca::hw
