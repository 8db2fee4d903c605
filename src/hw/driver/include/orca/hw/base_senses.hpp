// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "orca/geometry/error_guess.hpp"
#include "orca/geometry/pose2.hpp"
#include "orca/hw/endpoints.hpp"
#include "orca/idl/hardware.hpp"
#include "orca/idl/navigation.hpp"
#include "orca/idl/sensing.hpp"

namespace orca::hw {

/// The sonars of a base, as an endpoint, with the latest range of each.
///
/// Thread contract: not synchronised; the container's strand.
class BaseSonars {
 public:
  /// What all of them have in common. A plain value.
  struct Traits {
    double min_range = 0.0;  ///< [m]
    double max_range = 0.0;  ///< [m] What is farther away is as far.
    double half_lobe = 0.0;  ///< [rad]
    Duration cycle{0};       ///< In which each has fired once.
    RangeErrorGuess errors{};
  };

  /// @param period  from reading to reading.
  BaseSonars(const Traits& traits, Duration period) : traits_(traits), endpoint_(period) {}

  [[nodiscard]] SensorEndpoint& endpoint() { return endpoint_; }
  /// Adds a sonar that has not measured yet. @param height  [m] above the floor.
  void add(const Pose2& place, double height);
  void clear();
  [[nodiscard]] std::size_t count() const { return sonars_.size(); }

  /// Takes what a sonar has measured at an instant. @param range  [m]
  void take(std::size_t sonar, double range, TimePoint stamp);
  /// Takes the last ranges of all, of which it is not known when they were measured: one that has changed was measured now, and one that
  /// has not at most a whole cycle ago.
  /// @param range_of  returns the range [m] of a sonar.
  template <class RangeOf>
  void take_all(TimePoint stamp, RangeOf&& range_of) {
    for (std::size_t i = 0; i < sonars_.size(); ++i) {
      const double range = range_of(i);
      take(i, range, range != sonars_[i].told ? stamp : std::max(sonars_[i].stamp, stamp - traits_.cycle));
    }
  }
  /// Forgets what was measured, but not when.
  void forget();

  /// Publishes the ranges as they are. @param stamp  when they came.
  void publish(TimePoint stamp);
  /// Publishes them once in a cycle: an old range that is published again would count as another echo.
  void publish_round(TimePoint stamp);
  /// Publishes no round before each sonar has fired, which they are told to do now.
  void await_round(TimePoint now) { published_ = now + traits_.cycle; }

  /// Describes them; radius, even spacing and raw units are left out.
  [[nodiscard]] idl::SonarRing describe(const std::string& name) const;

 private:
  struct Sonar {
    idl::Frame3D place;
    double told;   // [m] the last range, which may be beyond max_range
    double range;  // [m]
    TimePoint stamp;
  };

  const Traits traits_;
  SensorHW<idl::SonarRangeReadings> endpoint_;
  std::vector<Sonar> sonars_;
  TimePoint published_{};  // the last round; ahead of now while the first one is awaited
};

/// The bumper switches of a base, as an endpoint.
///
/// Thread contract: not synchronised; the container's strand.
class BaseBumpers {
 public:
  /// @param period  from reading to reading.
  /// @param radius  [m] of the circle on which they lie; 0: that is not known.
  explicit BaseBumpers(Duration period, double radius = 0.0) : radius_(radius), endpoint_(period) {}

  [[nodiscard]] SensorEndpoint& endpoint() { return endpoint_; }
  /// Adds a switch. @param direction  [rad] in which it faces, 0 ahead, positive to the left.
  void add(const std::string& name, double direction);
  void clear() { switches_.clear(); }
  [[nodiscard]] std::size_t count() const { return switches_.size(); }

  /// Notes whether a switch is pressed.
  /// @param way  where the robot drives to: one that is pressed meanwhile is taken to lie there, until it is let go; 0: where it faces.
  void take(std::size_t number, bool is_pressed, const Vec2& way = {});
  /// Takes all for let go.
  void forget();
  /// Returns those that are pressed, for MotionHW::press().
  [[nodiscard]] std::vector<Obstruction::Pressed> pressed() const;
  /// Publishes the first `most` of them.
  void publish(TimePoint stamp, std::size_t most = ~std::size_t{0});

 private:
  struct Switch {
    std::string name;
    Vec2 faces;     // outwards, of length 1
    Vec2 outwards;  // where it is taken to lie
    bool is_pressed;
  };

  const double radius_;
  SensorHW<idl::BumperReadings> endpoint_;
  std::vector<Switch> switches_;
};

/// What a base tells of a battery. A plain value.
struct BatteryReading {
  double voltage = std::nan("");  ///< [V] Not a number: not known.
  double charge = std::nan("");   ///< [1] Likewise.
  bool charging = false;
  double temperature = std::nan("");  ///< [degC] Likewise.
  std::string name = "drive";
};

/// Notices a battery that is nearly empty, by its charge. Drivers that know the battery judge voltages themselves.
///
/// Thread contract: not synchronised; the container's strand.
class ChargeWatch {
 public:
  /// Takes a reading. A charge that is not known says nothing.
  void take(const BatteryReading& reading);
  /// Returns what is to be said now, once until it was charged; empty: nothing.
  [[nodiscard]] std::string take_remark() { return std::exchange(remark_, {}); }

 private:
  bool is_low_ = false;
  std::string remark_;
};

/// Publishes what is known of a battery.
void publish_battery(SensorHW<idl::Battery>& endpoint, const BatteryReading& reading, TimePoint stamp);

}  // namespace orca::hw
