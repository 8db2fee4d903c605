// SPDX-License-Identifier: LGPL-3.0-or-later
#include <algorithm>

#include "orca/avoidance/avoider.hpp"
#include "orca/avoidance/free_way.hpp"
#include "orca/geometry/objects/plane.hpp"
#include "orca/idl/time.hpp"

namespace {

/// An avoid behaviour that keeps the robot from driving into what its sonars hear (thesis 11.1). See
/// README.md.
class SonarAvoid final : public orca::avoid::Avoider {
 public:
  explicit SonarAvoid(orca::ComponentHost& host) : Avoider(host, {.echo_time = 0.25}) {}

 private:
  orca::PushProxyHandle& sensor() override { return sonar_; }
  [[nodiscard]] const orca::ObjectType& sensed() const override {
    return orca::object_type<orca::idl::SonarRangeReadings>();
  }

  // An echo may come from anywhere on the arc of the cone; the middle of the arc is used. An obstacle below
  // the minimum range may be at the sonar itself. The sonars fire one after the other, and the robot moves
  // meanwhile.
  void listen(orca::avoid::EchoMemory& memory) override {
    const auto readings = sonar_.get_update();
    const std::size_t count = std::min(readings->ranges().size(), readings->poses().size());
    for (std::size_t i = 0; i < count; ++i) {
      const auto echo = orca::avoid::echo_of(readings->ranges()[i], readings->min_range(),
                                             readings->max_range(), orca::plane_pose(readings->poses()[i]));
      if (!echo) continue;
      const double age = i < readings->stamps().size()
                             ? orca::to_seconds(now() - orca::to_time_point(readings->stamps()[i]))
                             : 0.0;
      memory.hear(moved_since(*echo, age), keep());
    }
  }

  orca::avoid::Advice advice(const orca::avoid::EchoMemory& memory, const orca::avoid::Situation& situation,
                             const orca::avoid::Limits& limits) override {
    return free_way_.advice(memory, situation, limits);
  }

  orca::avoid::FreeWay free_way_{*this};
  orca::PushProxy<orca::idl::SonarRangeReadings> sonar_{*this, "sonar", {.text = "Readings of the sonars."}};
};

}  // namespace

ORCA_COMPONENT(SonarAvoid, "orca.SonarAvoid")
