// SPDX-License-Identifier: LGPL-3.0-or-later
#include "orca/component.hpp"
#include "orca/hw/server.hpp"

namespace {

/// The server of a simulator's true pose: `RobotPosePush` and `RobotPoseQuery`. Real hardware does not know
/// the true pose, so with it this component has no ports.
class TruthLocalizer final : public orca::hw::HardwareServer {
 public:
  explicit TruthLocalizer(orca::ComponentHost& host) : HardwareServer(host, orca::hw::Source::truth) {}
};

}  // namespace

ORCA_COMPONENT(TruthLocalizer, "orca.TruthLocalizer")
