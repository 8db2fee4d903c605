// SPDX-License-Identifier: LGPL-3.0-or-later
#include "camera_driver.hpp"
#include "orca/hardware.hpp"

namespace {

/// A camera of Linux (Video4Linux2), such as one at a USB port: its pictures, in the size and at the rate that are nearest to those asked for.
class Camera final : public orca::hw::camera::CameraDriver {
 public:
  explicit Camera(orca::hw::HardwareHost& host) : CameraDriver(host, orca::hw::camera::make_system_video()) {}
};

}  // namespace

ORCA_HARDWARE(Camera, "orca.hw.Camera")
