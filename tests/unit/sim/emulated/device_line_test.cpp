// SPDX-License-Identifier: GPL-3.0-or-later
#include <catch2/catch.hpp>

#include <array>
#include <cstdlib>
#include <memory>
#include <thread>
#include <vector>

#include "device_line.hpp"
#include "free_port.hpp"
#include "orca/base/steady_clock.hpp"
#include "orca/hw/link/make_link.hpp"
#include "temp_folder.hpp"

using namespace orca;
using namespace orca::sim;
using namespace std::chrono_literals;
using Catch::Contains;

namespace {

// Answers every byte with the next one.
class Counter : public emulators::Firmware {
 public:
  void take(std::span<const std::uint8_t> bytes, std::uint32_t baud, TimePoint) override {
    for (const std::uint8_t byte : bytes) answer_.push_back(static_cast<std::uint8_t>(byte + 1));
    heard_at = baud;
  }
  std::vector<std::uint8_t> advance(TimePoint) override { return std::exchange(answer_, {}); }
  void reset(TimePoint) override {}
  std::uint32_t heard_at = 0;

 private:
  std::vector<std::uint8_t> answer_;
};

// The same, for any number of hosts.
class Sociable final : public Counter {
 public:
  std::unique_ptr<emulators::Firmware> for_another_host() override { return std::make_unique<Sociable>(); }
};

// The runtime folder of a test, as long as it lives.
struct Runtime {
  Runtime() { setenv("XDG_RUNTIME_DIR", folder.path().c_str(), 1); }
  test::TempFolder folder;
};

std::unique_ptr<hw::link::ByteLink> driver_of(const char* text) {
  auto link = hw::link::make_link(text, {.line = {.baud = 19200}});
  REQUIRE(link);
  return std::move(*link);
}

}  // namespace

TEST_CASE("a driver finds an emulated device by the name of its line, and both pass bytes on", "[emulated]") {
  const Runtime runtime;
  auto firmware = std::make_unique<Counter>();
  const Counter& counter = *firmware;
  DeviceLine line("counter", std::move(firmware));
  REQUIRE(line.open().ok());
  const auto driver = driver_of("emulated:counter");
  REQUIRE(open_within(*driver, 5s).ok());
  const std::array<std::uint8_t, 2> sent{7, 41};
  REQUIRE(driver->write(sent).ok());
  std::vector<std::uint8_t> heard;
  for (int i = 0; i < 2000 && heard.size() < 2; ++i) {
    line.exchange(steady_now());
    std::array<std::uint8_t, 16> bytes{};
    const auto count = driver->read(bytes);
    REQUIRE(count);
    heard.insert(heard.end(), bytes.begin(), bytes.begin() + static_cast<std::ptrdiff_t>(*count));
    std::this_thread::sleep_for(1ms);
  }
  CHECK(heard == std::vector<std::uint8_t>{8, 42});
  CHECK(counter.heard_at == 19200);
}

TEST_CASE("a driver waits for an emulation that starts later", "[emulated]") {
  const Runtime runtime;
  const auto driver = driver_of("emulated:late");
  const auto first = driver->open();
  REQUIRE(first);
  CHECK(*first == hw::link::Opening::under_way);
  DeviceLine line("late", std::make_unique<Counter>());
  REQUIRE(line.open().ok());
  CHECK(open_within(*driver, 5s).ok());
}

TEST_CASE("a driver gives up when no emulation of its name comes", "[emulated]") {
  const Runtime runtime;
  TimePoint now{};
  auto made = hw::link::make_link("emulated:never", {.now = [&now] { return now; }});
  REQUIRE(made);
  CHECK(*(*made)->open() == hw::link::Opening::under_way);
  now += 9s;
  CHECK(*(*made)->open() == hw::link::Opening::under_way);
  now += 2s;
  const auto given_up = (*made)->open();
  REQUIRE_FALSE(given_up);
  CHECK(given_up.error().code == Code::not_found);
}

TEST_CASE("two systems cannot offer a line of one name, and the first one keeps it", "[emulated]") {
  const Runtime runtime;
  DeviceLine first("robot", std::make_unique<Counter>());
  REQUIRE(first.open().ok());
  DeviceLine second("robot", std::make_unique<Counter>());
  const Status refused = second.open();
  REQUIRE_FALSE(refused.ok());
  CHECK(refused.error().code == Code::already_exists);
  CHECK_THAT(refused.error().message,
             Contains("the line \"robot\" is offered by another system that runs; stop it, or choose"));
  const auto driver = driver_of("emulated:robot");
  CHECK(open_within(*driver, 5s).ok());
  first.close();
  CHECK(second.open().ok());
}

TEST_CASE("the name of an emulation is no path", "[emulated]") {
  const auto link = hw::link::make_link("emulated:../x");
  REQUIRE_FALSE(link);
  CHECK_THAT(link.error().message, Contains("the name of an emulation is no path"));
}

TEST_CASE("a driver finds an emulated device at its port, where no rate is set", "[emulated]") {
  const std::string port = std::to_string(test::free_port());
  auto firmware = std::make_unique<Counter>();
  const Counter& counter = *firmware;
  DeviceLine line("listen:" + port, std::move(firmware));
  REQUIRE(line.open().ok());
  CHECK_FALSE(line.exchange(steady_now()));  // nobody is there
  const auto driver = driver_of(("tcp:127.0.0.1:" + port).c_str());
  REQUIRE(open_within(*driver, 5s).ok());
  const std::array<std::uint8_t, 2> sent{7, 41};
  REQUIRE(driver->write(sent).ok());
  std::vector<std::uint8_t> heard;
  for (const TimePoint end = steady_now() + 5s; heard.size() < 2 && steady_now() < end;) {
    (void)line.exchange(steady_now());
    std::array<std::uint8_t, 8> bytes{};
    const auto count = driver->read(bytes);
    REQUIRE(count);
    heard.insert(heard.end(), bytes.begin(), bytes.begin() + static_cast<std::ptrdiff_t>(*count));
  }
  CHECK(heard == std::vector<std::uint8_t>{8, 42});
  CHECK(counter.heard_at == 0);
  DeviceLine rival("listen:" + port, std::make_unique<Counter>());
  const Status taken = rival.open();
  REQUIRE_FALSE(taken.ok());
  CHECK_THAT(taken.error().text(), Contains("another program listens there"));
}

TEST_CASE("a device that has several hosts serves each of them, and another one when one has gone",
          "[emulated]") {
  const std::string port = std::to_string(test::free_port());
  DeviceLine line("listen:" + port, std::make_unique<Sociable>());
  REQUIRE(line.open().ok());
  const auto answer_to = [&](hw::link::ByteLink& driver, std::uint8_t said) {
    REQUIRE(driver.write(std::array<std::uint8_t, 1>{said}).ok());
    std::array<std::uint8_t, 8> heard{};
    for (const TimePoint end = steady_now() + 5s; steady_now() < end;) {
      (void)line.exchange(steady_now());
      const auto count = driver.read(heard);
      REQUIRE(count);
      if (*count > 0) return static_cast<int>(heard[0]);
    }
    return -1;
  };
  std::vector<std::unique_ptr<hw::link::ByteLink>> drivers;
  for (std::uint8_t i = 0; i < 3; ++i) {
    drivers.push_back(driver_of(("tcp:127.0.0.1:" + port).c_str()));
    REQUIRE(open_within(*drivers.back(), 5s).ok());
    CHECK(answer_to(*drivers.back(), i) == i + 1);
  }
  CHECK(answer_to(*drivers[0], 10) == 11);
  drivers[1]->close();
  CHECK(answer_to(*drivers[2], 20) == 21);
  drivers[1] = driver_of(("tcp:127.0.0.1:" + port).c_str());
  REQUIRE(open_within(*drivers[1], 5s).ok());
  CHECK(answer_to(*drivers[1], 30) == 31);
  line.close();
  CHECK_FALSE(open_within(*driver_of(("tcp:127.0.0.1:" + port).c_str()), 1s).ok());
}
