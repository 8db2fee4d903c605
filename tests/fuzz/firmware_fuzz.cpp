// SPDX-License-Identifier: GPL-3.0-or-later
// Bytes of any host to the emulations of devices: whatever comes, they go on, and tell the wheels finite speeds.
#include <algorithm>
#include <array>
#include <cstdint>
#include <cstdlib>
#include <span>

#include "orca/emulators/create2_firmware.hpp"
#include "orca/emulators/nomad_scout_firmware.hpp"
#include "orca/emulators/p2os_firmware.hpp"
#include "orca/emulators/player_firmware.hpp"
#include "orca/emulators/rplidar_firmware.hpp"
#include "orca/emulators/xr4000_firmware.hpp"

using namespace orca;

namespace {

class FuzzedBody final : public emulators::Body {
 public:
  void drive(const Twist2& velocity) override {
    if (!is_finite(velocity)) std::abort();
    velocity_ = velocity;
  }
  [[nodiscard]] Pose2 odometry() const override {
    return {velocity_.forward, 0.0, wrapped(velocity_.turn_rate)};
  }
  [[nodiscard]] Twist2 velocity() const override { return velocity_; }
  [[nodiscard]] std::optional<double> sonar(int number) const override {
    if (number < 0 || number > 47) std::abort();
    return 0.1 * number;
  }
  void move_gripper(emulators::GripperMove move) override { last_move_ = move; }
  [[nodiscard]] std::optional<emulators::GripperLook> gripper() const override {
    return emulators::GripperLook{.paddles_move = last_move_ == emulators::GripperMove::open};
  }

 private:
  Twist2 velocity_;
  emulators::GripperMove last_move_ = emulators::GripperMove::stop;
};

class FuzzedMirror final : public emulators::Mirror {
 public:
  [[nodiscard]] std::optional<emulators::MirrorTurn> last_turn() const override {
    return emulators::MirrorTurn{{}, 3.0, -0.5, ranges_};
  }

 private:
  const std::array<double, 12> ranges_{0.0, 0.1, 1.0, 2.0, 3.0, 11.9, 12.1, 20.0, 1e9, 4.0, 5.0, 6.0};
};

// The bytes come in pieces, whose sizes they name themselves.
void talk(emulators::Firmware& device, std::span<const std::uint8_t> bytes, std::uint32_t baud,
          Duration more = 10s) {
  TimePoint now{1s};
  while (!bytes.empty()) {
    const std::span<const std::uint8_t> piece =
        bytes.first(std::min<std::size_t>(1 + bytes[0] % 32, bytes.size()));
    device.take(piece, baud, now);
    now += 7ms;
    (void)device.advance(now);
    bytes = bytes.subspan(piece.size());
  }
  (void)device.advance(now + more);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  FuzzedBody body;
  emulators::NomadScoutFirmware scout(body);
  talk(scout, {data, size}, 38400);
  emulators::Create2Firmware create(body);
  talk(create, {data, size}, 115200);
  emulators::P2osFirmware pioneer(body);
  talk(pioneer, {data, size}, 9600);
  FuzzedMirror mirror;
  emulators::RplidarFirmware laser(mirror, {.boot = 0s, .spin_up = 1ms});
  talk(laser, {data, size}, 115200, 300ms);  // it may send 2000 points a second
  emulators::Xr4000Firmware xr4000(body);
  talk(xr4000, {data, size}, 115200);
  emulators::PlayerFirmware player(body);
  const auto other_client = player.for_another_host();
  talk(player, {data, size}, 0);
  talk(*other_client, {data, size}, 0);
  return 0;
}
