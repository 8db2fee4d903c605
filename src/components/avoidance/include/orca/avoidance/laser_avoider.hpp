// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "orca/avoidance/avoider.hpp"
#include "orca/avoidance/footprint.hpp"

namespace orca::avoid {

/// The common part of avoid behaviours that listen to a laser at a port `laser`, and to any number of further ones at a port
/// `more_lasers`: one that looks back, or one near the floor. A derived class chooses the direction.
///
/// Thread contract: as every component.
class LaserAvoider : public Avoider {
 protected:
  /// The wishes for the memory of scans.
  struct Memory {
    bool hidden =
        false;  ///< Whether it keeps what lies behind something else: a body that turns may touch it.
    bool shapes =
        false;  ///< The shape of what is near, not only its nearest points: a body turns its corners past it.
    double time =
        4.0;  ///< [s] The default for how long. A laser invents no echoes: one that it saw once counts for as long as others.
    double range =
        0.0;  ///< [m] from the robot's centre; echoes nearer than this are kept even if they change no advice.
  };
  explicit LaserAvoider(ComponentHost& host) : LaserAvoider(host, Memory()) {}
  LaserAvoider(ComponentHost& host, Memory memory);

  /// Returns the body that counts as it is, instead of its circle: none, unless the robot is to squeeze through; that which
  /// the base describes; without one, that of the parameters.
  [[nodiscard]] std::optional<Rectangle> body() const;
  /// Returns the outline that counts: that body, or its circle.
  [[nodiscard]] Footprint outline() const { return outline_of(body()); }

  /// Returns the limits with the body that counts, if the robot is to squeeze through and its circle finds no way: that which
  /// the base describes; without one, that of the parameters.
  /// @param echoes  those that the advice is for.
  [[nodiscard]] Limits with_body(std::span<const Vec2> echoes, const Situation& situation,
                                 Limits limits) const;

  // A derived class that overrides these calls them too.
  Status configure() override;
  Status start() override;
  void stop() override;

 private:
  using MoreLasers = PushProxyArray<idl::LaserRangeReadings>;
  struct Further {
    MoreLasers::Source source;
    std::uint32_t number;              // the sensor's, for the memory
    std::optional<TimePoint> heard{};  // When its last scan came, unless that was none.
    bool ahead = false;                // Whether it looks ahead.
  };

  PushProxyHandle& sensor() override { return laser_; }
  [[nodiscard]] const ObjectType& sensed() const override;
  bool listen(EchoMemory& memory) override;
  void listen_aside(EchoMemory& memory) override;
  [[nodiscard]] bool hears_aside(double longest) const override;
  [[nodiscard]] std::string silent_aside(double longest) const override;
  [[nodiscard]] bool is_covered() override;
  [[nodiscard]] std::string what_holds() override;
  [[nodiscard]] bool looks_ahead() const;
  [[nodiscard]] bool is_heard(const MoreLasers::Source& source, double longest) const;
  [[nodiscard]] Further& further(const MoreLasers::Source& source);
  // Returns whether the scan counts.
  bool put_into(EchoMemory& memory, const idl::LaserRangeReadings& readings, std::uint32_t number);

  Memory remembers_;
  Param<bool> squeeze_;
  Param<double> robot_length_;
  Param<double> robot_width_;
  PushProxy<idl::LaserRangeReadings> laser_{*this, "laser", {.text = "Scans of the laser."}};
  MoreLasers more_lasers_{
      *this,
      "more_lasers",
      {.text = "Scans of further lasers; needs odometry. The robot stands while one of them is silent.",
       .optional = true}};
  std::vector<Further> further_;
  bool ahead_ = true;  // Whether the laser looks ahead; true until a scan says otherwise.
};

}  // namespace orca::avoid
