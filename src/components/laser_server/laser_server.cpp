// SPDX-License-Identifier: LGPL-3.0-or-later
#include <atomic>
#include <string>
#include <vector>

#include "ignored.hpp"
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
    const orca::Result<orca::laser::Ignored> ignored = orca::laser::Ignored::parse(*ignore_);
    if (!ignored) return ignore_.refuse(ignored.error());
    ignored_ = *ignored;
    if (seat() != nullptr) {
      const orca::idl::Robot robot = seat()->description();
      robot_ = {robot.radius(), robot.length(), robot.width()};
    }
    return HardwareServer::configure();
  }

  orca::Outcome work() override {
    if (const std::size_t count = left_out_; count != told_) {
      told_ = count;
      log_info("leaves out " + std::to_string(count) +
               " beams of a scan, as its parameter ignore says: " + orca::listed(*ignore_));
    }
    return HardwareServer::work();
  }

  void amend(orca::ObjectLoan& reading) const override {
    if (ignored_.empty() || reading.type().name != "LaserRangeReadings") return;
    const std::size_t count =
        ignored_.leave_out(*static_cast<orca::idl::LaserRangeReadings*>(reading.get()), robot_);
    if (count > left_out_) left_out_ = count;
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

  orca::Param<std::vector<std::string>> ignore_{
      *this,
      "ignore",
      {},
      {.fixed = true,
       .text = "Beams to leave out, such as those that see the robot itself: \"sector FROM TO\" in degrees "
               "of the "
               "scan, \"box X1 Y1 X2 Y2\" in metres of the robot's frame, \"outline\"."}};
  orca::laser::Ignored ignored_;
  orca::RobotOutline robot_;
  mutable std::atomic<std::size_t> left_out_{0};  // most of a scan so far; written by the driver's strand
  std::size_t told_ = 0;

  orca::QueryServer<orca::idl::Ask, orca::idl::LaserSensor> description_{
      *this,
      "LaserSensorQuery",
      &LaserServer::on_describe,
      {.text =
           "Description of the first laser, or of the one that is named: mounting pose, beams and range."}};
};

}  // namespace

ORCA_COMPONENT(LaserServer, "orca.LaserServer")
