// SPDX-License-Identifier: LGPL-3.0-or-later
#include <algorithm>

#include "orca/component.hpp"
#include "orca/hw/server.hpp"
#include "orca/idl/sensing.hpp"

namespace {

/// The server of a camera of any make: its pictures by Push and Query.
class CameraServer final : public orca::hw::HardwareServer {
 public:
  explicit CameraServer(orca::ComponentHost& host)
      : HardwareServer(host, orca::hw::Source::sensor, &orca::object_type<orca::idl::Image>()) {}

 private:
  static bool gives_pictures(const orca::hw::HardwareSeat::Sensor& sensor) {
    return sensor.type->name == orca::object_type<orca::idl::Image>().name &&
           sensor.source == orca::hw::Source::sensor;
  }

  orca::Status configure() override {
    if (seat() != nullptr && !std::ranges::any_of(seat()->sensors(), gives_pictures))
      return orca::fail(orca::Code::failed_precondition,
                        "its hardware has no camera; bind hardware with a camera to this component");
    return HardwareServer::configure();
  }
};

}  // namespace

ORCA_COMPONENT(CameraServer, "orca.CameraServer")
