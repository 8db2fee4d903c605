// SPDX-License-Identifier: LGPL-3.0-or-later
#include "orca/avoidance/ring_avoider.hpp"

namespace {

/// An avoid behaviour that keeps the robot from driving into what its infrared sensors see. See README.md.
class InfraredAvoid final : public orca::avoid::RingAvoider<orca::idl::InfraredRangeReadings> {
 public:
  explicit InfraredAvoid(orca::ComponentHost& host)
      : RingAvoider(host, {.echo_time = 0.25}, {"infrared", "infrared sensor", "measured", "see"}) {}
};

}  // namespace

ORCA_COMPONENT(InfraredAvoid, "orca.InfraredAvoid")
