// SPDX-License-Identifier: LGPL-3.0-or-later
#include <algorithm>
#include <optional>

#include "orca/avoidance/avoider.hpp"
#include "orca/avoidance/sonar_ear.hpp"

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

  orca::Status start() override {
    ear_.clear();
    return Avoider::start();
  }

  // The sonars fire one after the other, and the robot moves meanwhile.
  bool listen(orca::avoid::EchoMemory& memory) override {
    const auto readings = sonar_.get_update();
    if (!is_valid(*readings) || !fires(*readings)) return false;
    ear_.take(*readings, now(), !remembers(), [&](orca::Vec2 echo, orca::TimePoint fired) {
      memory.hear(moved_since(echo, age_of(fired)), keep());
    });
    return true;
  }

  // Returns whether a sonar has fired lately. A base reports its ring even if the sonars are off.
  bool fires(const orca::idl::SonarRangeReadings& readings) {
    const auto last = orca::avoid::SonarEar::last_firing(readings);
    return !last || is_valid(readings, last_firing(age_of(*last)));
  }

  // Checks the age of the last firing. A driver that does not know which sonar has fired takes a range that stays the same
  // for a round old.
  [[nodiscard]] orca::Status last_firing(double age) const {
    constexpr double kRound = 0.5;  // [s] in which the slowest known ring fires once
    const double limit = deaf_after() + kRound;
    if (age <= limit) return orca::check_age(age, limit);
    return orca::fail(orca::Code::invalid_argument,
                      "no sonar has fired for " + std::to_string(age) + " s; are the sonars off?");
  }

  [[nodiscard]] std::string what_holds() override {
    const auto round = sonar_.latest();
    if (!round) return {};
    const auto near =
        std::ranges::count_if(round->ranges(), [&](double range) { return range <= round->min_range(); });
    if (near == 0) return {};
    return std::to_string(near) + " of the " + std::to_string(round->ranges().size()) + " sonars of \"" +
           round->origin() + "\" hear something nearer than they can measure";
  }

  orca::avoid::Advice advice(const orca::avoid::EchoMemory& memory, const orca::avoid::Situation& situation,
                             const orca::avoid::Limits& limits) override {
    orca::avoid::Limits mine = limits;
    mine.side_distance = *side_distance_;
    return avoid(memory.echoes(), situation, mine);
  }

  orca::Param<double> side_distance_{
      *this,
      "side_distance",
      0.2,
      {.unit = "m",
       .min = 0.0,
       .text = "An echo nearer to the robot's circle than this counts as a wall across its beam."}};
  orca::PushProxy<orca::idl::SonarRangeReadings> sonar_{*this, "sonar", {.text = "Readings of the sonars."}};
  orca::avoid::SonarEar ear_;
};

}  // namespace

ORCA_COMPONENT(SonarAvoid, "orca.SonarAvoid")
