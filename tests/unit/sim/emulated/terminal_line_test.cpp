// SPDX-License-Identifier: GPL-3.0-or-later
#include <catch2/catch.hpp>

#include <array>
#include <cstdlib>
#include <memory>
#include <thread>
#include <vector>

#include "orca/base/steady_clock.hpp"
#include "orca/hw/link/make_link.hpp"
#include "temp_folder.hpp"
#include "terminal_line.hpp"

using namespace orca;
using namespace orca::sim;
using namespace std::chrono_literals;
using Catch::Contains;

namespace {

// Answers every byte with the next one.
class Counter final : public emulators::Firmware {
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
  TerminalLine line("counter", std::move(firmware));
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
  TerminalLine line("late", std::make_unique<Counter>());
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
  TerminalLine first("robot", std::make_unique<Counter>());
  REQUIRE(first.open().ok());
  TerminalLine second("robot", std::make_unique<Counter>());
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
