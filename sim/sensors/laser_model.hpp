// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <optional>
#include <vector>

#include "orca/base/random.hpp"
#include "orca/geometry/pose2.hpp"
#include "orca/sim/caster.hpp"
#include "orca/sim/readings.hpp"
#include "orca/sim/realism.hpp"
#include "orca/sim/robot_model.hpp"
#include "tick_span.hpp"

namespace orca::sim::detail {

// A scanning laser. Each beam is cast from the robot's pose at that beam's own instant. The last beam of a
// scan falls at the end of the period.
class LaserModel {
 public:
  // @param own  what its beams meet of the robot itself, in the base frame.
  LaserModel(LaserScanner scanner, const std::vector<Shape>& own, const ErrorLevels& errors,
             RandomStream random, TimePoint start);

  // Shoots every beam that is due in the span.
  void run(const Caster& caster, std::size_t own_body, const TickSpan& span);

  // Returns the scan that was completed in the last run(), if one was.
  [[nodiscard]] const std::optional<LaserScan>& completed() const { return completed_; }

 private:
  struct Beam {
    Ray ray;
    double angle;  // [rad] In the sensor frame.
    Hit hit;
  };

  [[nodiscard]] TimePoint due(std::size_t beam) const;
  [[nodiscard]] Ray ray(const Pose2& X_WB, double beam, std::size_t own_body) const;
  void look(const Caster& caster, std::size_t own_body, const TickSpan& span);
  void shoot(const Caster& caster, const Beam& beam);
  [[nodiscard]] Hit seen(const Caster& caster, const Ray& ray, double angle, Hit hit) const;
  [[nodiscard]] Hit through_glass(const Caster& caster, const Ray& ray, Hit hit) const;
  void look_at_own(double angle, Hit& hit) const;
  [[nodiscard]] bool returns(const Hit& hit) const;
  [[nodiscard]] double strength_of(const Hit& hit) const;
  void mix(const Caster& caster, const Beam& beam, double rim, double& range) const;
  void complete();
  [[nodiscard]] double measured(double range, double strength);

  LaserScanner scanner_;
  std::vector<Circle> own_circles_;  // Of the robot itself, in the base frame.
  std::vector<Segment> own_edges_;
  ErrorLevels errors_;
  RandomStream random_;
  double drop_tangent_;
  double bias_;  // [m] Range error of this device in this run.
  TimePoint scan_end_;
  Caster::View view_;
  Beam previous_;
  std::vector<double> ranges_;  // [m] The present scan without noise; max_range: nothing came back.
  std::vector<double>
      strengths_;  // Of its echoes, as multiples of the weakest that half of the beams return.
  Pose2 X_RB_;     // Pose of the carrier in the robot's frame when the present scan began.
  std::optional<LaserScan> completed_;
};

}  // namespace orca::sim::detail
