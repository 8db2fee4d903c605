// SPDX-License-Identifier: LGPL-3.0-or-later
#include <algorithm>
#include <optional>
#include <vector>

#include "orca/avoidance/avoider.hpp"
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

  orca::Status start() override {
    fired_.clear();
    return Avoider::start();
  }

  // An echo may come from anywhere on the arc of the cone; the middle of the arc is used. An obstacle below
  // the minimum range may be at the sonar itself. The sonars fire one after the other, and the robot moves
  // meanwhile.
  bool listen(orca::avoid::EchoMemory& memory) override {
    const auto readings = sonar_.get_update();
    if (!is_valid(*readings) || !fires(*readings)) return false;
    const std::size_t count = std::min(readings->ranges().size(), readings->poses().size());
    fired_.resize(count);
    for (std::size_t i = 0; i < count; ++i) {
      const bool has_stamp = i < readings->stamps().size();
      const orca::TimePoint fired = has_stamp ? orca::to_time_point(readings->stamps()[i]) : now();
      if (!is_news(i, fired)) continue;
      const auto echo = orca::avoid::echo_of(readings->ranges()[i], readings->min_range(),
                                             readings->max_range(), orca::plane_pose(readings->poses()[i]));
      if (echo) memory.hear(moved_since(*echo, age_of(fired)), keep());
    }
    return true;
  }

  // Returns whether a sonar has fired lately. A base reports its ring even if the sonars are off.
  bool fires(const orca::idl::SonarRangeReadings& readings) {
    std::optional<orca::TimePoint> last;
    for (const orca::idl::TimeValue& stamp : readings.stamps())
      last = std::max(last, std::optional(orca::to_time_point(stamp)));
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

  // Returns whether a reading is new. A base reports its whole ring more often than the ring makes its round. A repeated echo
  // would confirm itself, each time at another place, as the motion since it was heard is a guess.
  bool is_news(std::size_t sonar, orca::TimePoint fired) {
    if (remembers() && fired == fired_[sonar]) return false;
    fired_[sonar] = fired;
    return true;
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
  std::vector<std::optional<orca::TimePoint>> fired_;  // By sonar: the stamp of its last reading.
};

}  // namespace

ORCA_COMPONENT(SonarAvoid, "orca.SonarAvoid")
