// SPDX-License-Identifier: GPL-3.0-or-later
// Whether the frames of a device are found in its stream, hour after hour, and soon again after one that was spoiled.
#include <catch2/catch.hpp>

#include <algorithm>
#include <array>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "bad_line.hpp"
#include "hex_bytes.hpp"
#include "orca/emulators/create2_firmware.hpp"
#include "orca/emulators/nomad_scout_firmware.hpp"
#include "orca/emulators/p2os_firmware.hpp"
#include "orca/emulators/sick_lms_firmware.hpp"
#include "orca/emulators/xr4000_firmware.hpp"
#include "orca/geometry/arc.hpp"
#include "orca/hw/create2/sensors.hpp"
#include "orca/hw/nomad_scout/packet.hpp"
#include "orca/hw/p2os/packet.hpp"
#include "orca/hw/sick_lms/telegram.hpp"
#include "orca/hw/xr4000/frame.hpp"
#include "slow_run.hpp"

using namespace orca;
using namespace std::chrono_literals;
using hw::framing::Frame;
using hw::framing::Protocol;
using hw::framing::Scanner;
using hw::test::Bytes;
using hw::test::hex;

namespace {

constexpr Duration kStep = 100ms;
constexpr int kDevices = 5;

// Drives in curves, and hears and sees something else each time.
class RestlessBody final : public emulators::Body, public emulators::Mirror {
 public:
  void go_on() {
    pose_ = along_arc(pose_, Twist2{0.4, 0.0, 0.3} * to_seconds(kStep));
    for (double& range : ranges_) range = random_.uniform(0.2, 8.0);
  }
  void drive(const Twist2&) override {}
  [[nodiscard]] Pose2 odometry() const override { return pose_; }
  [[nodiscard]] Twist2 velocity() const override { return {0.4, 0.0, 0.3}; }
  [[nodiscard]] std::optional<double> sonar(int number) const override {
    return ranges_[static_cast<std::size_t>(number)];
  }
  [[nodiscard]] std::optional<emulators::MirrorTurn> last_turn() const override {
    return emulators::MirrorTurn{{}, -1.5, 0.05, ranges_};
  }

 private:
  Pose2 pose_;
  std::array<double, 61> ranges_{};
  RandomStream random_{1, "test", "surroundings"};
};

// What is said to the device so that it sends, and how its frames are found.
struct Device {
  std::string name;
  std::unique_ptr<emulators::Firmware> firmware;
  Protocol protocol;
  std::uint32_t baud = 9600;
  std::vector<std::string> greeting;  // a second apart, hexadecimal
  std::string question;               // at each step; empty: it sends by itself
};

Device make_device(int which, RestlessBody& body) {
  using namespace emulators;
  switch (which) {
    case 0:
      return {"Pioneer",
              std::make_unique<P2osFirmware>(body),
              hw::p2os::kProtocol,
              9600,
              {"FA FB 03 00 00 00", "FA FB 03 01 00 01", "FA FB 03 02 00 02", "FA FB 03 01 00 01",
               "FA FB 06 1C 3B 01 00 1D 3B"},
              ""};
    case 1:
      return {"Scout",
              std::make_unique<NomadScoutFirmware>(body),
              hw::nomad_scout::kProtocol,
              38400,
              {"01 13 00 0F 0F 00 02 0F 01 0E 03 0D 04 0C 05 0B 06 0A 07 09 08 AA 5C"},
              "01 02 00 07 0A 5C"};
    case 2:
      return {"Create", std::make_unique<Create2Firmware>(body), hw::create2::kProtocol,
              115200,   {"80", "94 07 07 09 0E 15 16 2B 2C"},    ""};
    case 3:
      return {"XR4000",
              std::make_unique<Xr4000Firmware>(body),
              hw::xr4000::kProtocol,
              115200,
              {"58 52 01 00 01 01 64 D1"},
              "58 52 00 00 02 DE EC 58 52 00 00 07 7B BC"};
    default:
      return {"LMS",
              std::make_unique<SickLmsFirmware>(body, SickLmsSettings{.power_up = 0s}),
              hw::sick_lms::kFromLaser,
              9600,
              {"02 00 02 00 20 24 34 08"},
              ""};
  }
}

struct Count {
  long sent = 0;
  long spoiled = 0;
  long found = 0;
  long most_missed = 0;  // good frames in a row
  hw::framing::Statistics statistics{};
};

// Follows the frames that were sent until each is found or known as missed.
class Comparison {
 public:
  Comparison(const Protocol& protocol, int spoil_one_in)
      : one_in_(spoil_one_in), sender_(protocol), receiver_(protocol) {}

  void pass(const Bytes& sent) {
    Bytes line;
    sender_.feed(sent, [&](const Frame& frame) {
      Bytes bytes(frame.bytes.begin(), frame.bytes.end());
      ++count_.sent;
      const bool spoils = one_in_ > 0 && count_.sent % one_in_ == 0;
      if (spoils) {
        ++count_.spoiled;
        bytes[random_() % bytes.size()] ^= static_cast<std::uint8_t>(1U << (random_() % 8));
      } else {
        expected_.push_back(bytes);
      }
      line.insert(line.end(), bytes.begin(), bytes.end());
    });
    receiver_.feed(line, [&](const Frame& frame) { find(frame); });
  }
  [[nodiscard]] Count result() {
    count_.statistics = receiver_.statistics();
    return count_;
  }
  [[nodiscard]] std::size_t not_found_yet() const { return expected_.size(); }

 private:
  void find(const Frame& frame) {
    const auto at = std::ranges::find_if(
        expected_, [&](const Bytes& bytes) { return std::ranges::equal(bytes, frame.bytes); });
    if (at == expected_.end()) return;
    ++count_.found;
    count_.most_missed = std::max(count_.most_missed, static_cast<long>(at - expected_.begin()));
    expected_.erase(expected_.begin(), at + 1);
  }

  const int one_in_;
  Scanner sender_;
  Scanner receiver_;
  RandomStream random_{1, "test", "spoiled"};
  std::vector<Bytes> expected_;
  Count count_;
};

// Lets the device send for so long, all of it as it comes from its line.
void let_send(Device& device, RestlessBody& body, Duration time, Comparison& comparison) {
  TimePoint now{10s};
  (void)device.firmware->advance(now);
  for (const std::string& words : device.greeting) {
    device.firmware->take(hex(words), device.baud, now);
    now += 1s;
    (void)device.firmware->advance(now);
  }
  const Bytes question = hex(device.question);
  for (const TimePoint end = now + time; now < end;) {
    if (!question.empty()) device.firmware->take(question, device.baud, now);
    now += kStep;
    body.go_on();
    comparison.pass(device.firmware->advance(now));
  }
}

void check_never_lost(Duration time) {
  for (int which = 0; which < kDevices; ++which) {
    RestlessBody body;
    Device device = make_device(which, body);
    Comparison comparison(device.protocol, 0);
    let_send(device, body, time, comparison);
    const Count count = comparison.result();
    INFO(device.name << ": " << count.sent << " frames");
    CHECK(count.sent > time / 1s);  // more than one in a second
    CHECK(count.found + static_cast<long>(comparison.not_found_yet()) == count.sent);
    CHECK(comparison.not_found_yet() <= 1);
    CHECK(count.statistics.bad_checksums == 0);
    CHECK(count.statistics.skipped_bytes == 0);
  }
}

}  // namespace

TEST_CASE("the frames of a device are found without a loss", "[emulators][framing]") {
  check_never_lost(orca::test::part_of(60) * 1min);
}

TEST_CASE("the frames of a device are found without a loss, for a thousand hours",
          "[emulators][framing][.][slow]") {
  check_never_lost(1000h);
}

TEST_CASE("when one frame in a hundred is spoiled, at most one good one is lost with it",
          "[emulators][framing]") {
  for (int which = 0; which < kDevices; ++which) {
    RestlessBody body;
    Device device = make_device(which, body);
    Comparison comparison(device.protocol, 100);
    const Duration time = orca::test::part_of(300) * 1min;
    let_send(device, body, time, comparison);
    const Count count = comparison.result();
    INFO(device.name << ": " << count.sent << " frames, " << count.spoiled << " spoiled");
    CHECK(count.spoiled >= time / 100s);
    CHECK(count.most_missed <= 1);
    CHECK(count.found + 2 * count.spoiled >= count.sent);
    CHECK(count.statistics.resynchronisations > 0);
  }
}
