// SPDX-License-Identifier: LGPL-3.0-or-later

#include "orca/component.hpp"
#include "orca/hw/description.hpp"
#include "orca/hw/server.hpp"
#include "orca/idl/hardware.hpp"
#include "orca/idl/system.hpp"

namespace {

/// The server of any robot base (thesis 11.1): all its sensors, its motion, and its description by Query.
class RobotBaseServer final : public orca::hw::HardwareServer {
 public:
  explicit RobotBaseServer(orca::ComponentHost& host) : HardwareServer(host, orca::hw::Source::sensor) {
    offer_motion();
  }

 private:
  orca::Result<orca::Loan<orca::idl::Robot>> on_describe(const orca::ObjectPtr<orca::idl::Ask>& ask) {
    return orca::hw::part_of(seat()->description(), ask->about());
  }

  orca::QueryServer<orca::idl::Ask, orca::idl::Robot> description_{
      *this,
      "RobotQuery",
      &RobotBaseServer::on_describe,
      {.text = "Description of the robot: all of it, its limits, one device, or the sensors of one object "
               "type."}};
};

}  // namespace

ORCA_COMPONENT(RobotBaseServer, "orca.RobotBaseServer")
