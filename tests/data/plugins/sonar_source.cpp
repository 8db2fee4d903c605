// SPDX-License-Identifier: GPL-3.0-or-later
#include "orca/component.hpp"
#include "orca/idl/sensing.hpp"

namespace {

/// Sixteen sonars, one of which hears something at `range`; the others hear nothing.
class SonarSource final : public orca::Component {
 public:
  explicit SonarSource(orca::ComponentHost& host) : Component(host) {
    lap_every(std::chrono::milliseconds(100));
  }

 private:
  orca::Outcome work() override {
    constexpr double kMaxRange = 6.5;
    auto readings = sonar_.loan();
    readings->ranges().assign(16, kMaxRange);
    readings->ranges()[5] = *range_;
    readings->poses().resize(16);
    readings->max_range(kMaxRange);
    sonar_.push(std::move(readings));
    return orca::again();
  }

  orca::PushServer<orca::idl::SonarRangeReadings> sonar_{*this, "sonar"};
  orca::Param<double> range_{*this, "range", 6.5, {.unit = "m", .min = 0.0}};
};

}  // namespace

ORCA_COMPONENT(SonarSource, "test.SonarSource")
