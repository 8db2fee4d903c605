// SPDX-License-Identifier: LGPL-3.0-or-later
#include "orca/avoidance/ring_avoider.hpp"

namespace {

/// An avoid behaviour that keeps the robot from driving into what its sonars hear (thesis 11.1). See
/// README.md.
class SonarAvoid final : public orca::avoid::RingAvoider<orca::idl::SonarRangeReadings> {
 public:
  explicit SonarAvoid(orca::ComponentHost& host)
      : RingAvoider(host, {.echo_time = 0.25}, {"sonar", "sonar", "fired", "hear"}) {}
};

}  // namespace

ORCA_COMPONENT(SonarAvoid, "orca.SonarAvoid")
