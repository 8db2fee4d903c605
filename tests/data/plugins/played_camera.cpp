// SPDX-License-Identifier: GPL-3.0-or-later
#include "camera_driver.hpp"
#include "fake_camera.hpp"
#include "orca/hardware.hpp"

namespace {

using orca::test::FakeCamera;

// Made before the driver, which uses it.
struct CameraOnDesk {
  explicit CameraOnDesk(orca::hw::HardwareHost& host)
      : camera({.formats = {{V4L2_PIX_FMT_RGB24, {{32, 16, 5.0}}}}}, [&host] { return host.now(); }) {
    constexpr std::size_t kBytes = std::size_t{32} * 16 * 3;
    camera.play(std::chrono::milliseconds(200), [](std::uint32_t number) {
      return orca::test::Bytes(kBytes, static_cast<std::uint8_t>(number));
    });
  }
  FakeCamera camera;
};

/// The driver of cameras with one that plays: picture after picture, of 32 x 16 pixels, in which each byte is the picture's number.
class PlayedCamera final : private CameraOnDesk, public orca::hw::camera::CameraDriver {
 public:
  explicit PlayedCamera(orca::hw::HardwareHost& host)
      : CameraOnDesk(host), CameraDriver(host, camera.calls()) {}
};

}  // namespace

ORCA_HARDWARE(PlayedCamera, "test.PlayedCamera")
