// SPDX-License-Identifier: GPL-3.0-or-later
#include "orca/hw/emulated_device.hpp"

#include <algorithm>
#include <catch2/catch.hpp>

#include "../fake_scout.hpp"

using namespace orca;
using namespace orca::test;
using namespace std::chrono_literals;
using Catch::Contains;
using hw::HardwareState;
using hw::link::MemoryLink;

namespace {

/// A device that says "t" each second, and "!" to each "?".
class WallClock final : public hw::EmulatedDevice {
 public:
  explicit WallClock(hw::HardwareHost& host) : EmulatedDevice(host, 1s) {}

 private:
  Bytes hear(std::span<const std::uint8_t> bytes) override {
    return Bytes(static_cast<std::size_t>(std::ranges::count(bytes, '?')), '!');
  }
  Bytes speak() override { return {'t'}; }
};

/// A clock whose strand runs as long as this lives, and the end of its line that a driver has.
struct RunningClock {
  explicit RunningClock(Executive& used, const std::string& lines = "clock wall")
      : executive(used), host(used, diary), clock(host) {
    host.set("lines", lines);
    REQUIRE(clock.prepare().empty());
    clock.run();
  }
  ~RunningClock() {
    clock.shut_down();
    CHECK(clock.join_until(executive.now() + 5s));
  }
  // Returns what a driver has heard by now.
  std::string heard() {
    std::array<std::uint8_t, 64> bytes{};
    const std::size_t count = driver.read(bytes).value_or(0);
    return {bytes.begin(), bytes.begin() + static_cast<std::ptrdiff_t>(count)};
  }

  Executive& executive;
  Diary diary;
  FakeHardwareHost host;
  WallClock clock;
  MemoryLink driver{{.name = "wall"}};
};

}  // namespace

TEST_CASE("an emulated device says in virtual time what it says by itself, while a driver is there",
          "[emulated_device]") {
  run_on_each(virtual_executives(), [](Executive& executive) {
    RunningClock wall(executive);
    sleep(executive, 3500ms);
    REQUIRE(wall.driver.open());
    sleep(executive, 2s);
    CHECK(wall.heard() == "tt");
  });
}

TEST_CASE("an emulated device answers at once, whatever the pieces in which it is asked",
          "[emulated_device]") {
  run_on_each(virtual_executives(), [](Executive& executive) {
    RunningClock wall(executive);
    REQUIRE(wall.driver.open());
    sleep(executive, 100ms);
    (void)wall.heard();
    const std::vector<std::uint8_t> asked(300, '?');
    REQUIRE(wall.driver.write(asked).ok());
    sleep(executive, 1ms);
    CHECK(wall.heard().size() == 64);  // as many as are read at once
    wall.driver.close();
    CHECK(wall.clock.state() == HardwareState::ready);
  });
}

TEST_CASE("an emulated device is refused in real time", "[emulated_device]") {
  run_on_each(steady_executives(), [](Executive& executive) {
    RunningClock wall(executive);
    CHECK(eventually(executive, [&] { return wall.clock.state() == HardwareState::fault; }));
    CHECK_THAT(wall.clock.fault(), Contains("write --clock virtual"));
  });
}

TEST_CASE("an emulated device needs a kind and the name of a line", "[emulated_device]") {
  run_on_each(virtual_executives(), [](Executive& executive) {
    Diary diary;
    FakeHardwareHost host(executive, diary);
    WallClock clock(host);
    for (const char* const lines : {"", "wall", "clock on wall"}) {
      host.set("lines", std::string(lines));
      CAPTURE(lines);
      REQUIRE(clock.prepare().size() == 1);
      CHECK(clock.prepare().front().param == "lines");
    }
  });
}
