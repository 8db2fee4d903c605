// SPDX-License-Identifier: LGPL-3.0-or-later
#include <string>
#include <vector>

#include "orca/base/text.hpp"
#include "orca/component.hpp"
#include "orca/hw/server.hpp"
#include "orca/idl/hardware.hpp"
#include "orca/idl/sensing.hpp"
#include "orca/idl/system.hpp"

namespace {

/// The server of a scanning laser of any brand (thesis 11.1, Fig. 11.4): scans by Push and Query, and the
/// description of the laser by Query.
class LaserServer final : public orca::hw::HardwareServer {
 public:
  explicit LaserServer(orca::ComponentHost& host)
      : HardwareServer(host, orca::hw::Source::sensor, &orca::object_type<orca::idl::LaserRangeReadings>()) {}

 private:
  orca::Status configure() override {
    if (seat() != nullptr && seat()->description().laser_sensors().empty())
      return orca::fail(orca::Code::failed_precondition,
                        "its hardware has no laser; bind hardware with a laser to this component");
    return HardwareServer::configure();
  }

  orca::Result<orca::Loan<orca::idl::LaserSensor>> on_describe(const orca::ObjectPtr<orca::idl::Ask>& ask) {
    const orca::idl::Robot robot = seat()->description();
    std::vector<std::string> names;
    for (const orca::idl::LaserSensor& laser : robot.laser_sensors()) {
      if (ask->about().empty() || ask->about() == laser.name())
        return orca::make_object<orca::idl::LaserSensor>(laser);
      names.push_back(laser.name());
    }
    return orca::fail(orca::Code::not_found, "its hardware has no laser " + orca::in_quotes(ask->about()) +
                                                 "; lasers: " + orca::listed(names));
  }

  orca::QueryServer<orca::idl::Ask, orca::idl::LaserSensor> description_{
      *this,
      "LaserSensorQuery",
      &LaserServer::on_describe,
      {.text =
           "Description of the first laser, or of the one that is named: mounting pose, beams and range."}};
};

}  // namespace

ORCA_COMPONENT(LaserServer, "orca.LaserServer")
