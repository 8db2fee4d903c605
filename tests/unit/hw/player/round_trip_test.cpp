// SPDX-License-Identifier: GPL-3.0-or-later
#include <catch2/catch.hpp>

#include <bit>

#include "orca/base/random.hpp"
#include "orca/hw/player/position2d.hpp"
#include "orca/hw/player/sensors.hpp"
#include "orca/hw/player/session.hpp"
#include "player_bytes.hpp"

using namespace orca::hw::player;
using namespace orca::hw::player::test;
using orca::RandomStream;

namespace {

// Payloads of random values.
class Maker {
 public:
  std::size_t count() { return random_() % 20; }
  std::uint32_t number() { return static_cast<std::uint32_t>(random_()); }
  double real() { return random_.uniform(-1e6, 1e6); }
  float single() { return static_cast<float>(real()); }
  bool flag() { return random_.chance(0.5); }
  template <class Make>
  auto list(Make make) {
    std::vector<decltype(make())> made(count());
    for (auto& element : made) element = make();
    return made;
  }
  std::string text() {
    std::string made(count(), ' ');
    for (char& c : made) c = static_cast<char>('!' + random_() % 90);
    return made;
  }
  Address address() { return {number(), number(), static_cast<Interface>(number()), number()}; }
  Pose3 pose() { return {real(), real(), real(), real(), real(), real()}; }
  Size3 size() { return {real(), real(), real()}; }
  Planar planar() { return {real(), real(), real()}; }
  LaserScan scan() {
    return {single(),
            single(),
            single(),
            single(),
            list([this] { return single(); }),
            list([this] { return static_cast<std::uint8_t>(number()); }),
            number()};
  }
  RangerGeometry ranger_geometry() {
    return {pose(), size(), list([this] { return pose(); }), list([this] { return size(); })};
  }
  RangerConfig ranger_config() { return {real(), real(), real(), real(), real(), real(), real()}; }

 private:
  RandomStream random_{1, "test", "player"};
};

template <class Payload>
bool survives(const Payload& payload) {
  const Bytes bytes = encode(payload);
  const auto read = decode<Payload>(bytes);
  return bytes.size() % 4 == 0 && read.has_value() && *read == payload;
}

}  // namespace

TEST_CASE("what is written is read again: session", "[hw][player]") {
  Maker make;
  for (int round = 0; round < 200; ++round) {
    CHECK(survives(DeviceList{make.list([&] { return make.address(); })}));
    CHECK(survives(DriverInfo{make.address(), make.text()}));
    CHECK(survives(Subscription{make.address(), Access::close, make.text()}));
    CHECK(survives(Capability{make.number(), make.number()}));
  }
}

TEST_CASE("what is written is read again: position2d, bumper and power", "[hw][player]") {
  Maker make;
  for (int round = 0; round < 200; ++round) {
    CHECK(survives(Position2dState{make.planar(), make.planar(), make.flag()}));
    CHECK(survives(VelocityCommand{make.planar(), make.flag()}));
    CHECK(survives(Geometry{make.pose(), make.size()}));
    CHECK(survives(BumperState{make.list([&] { return static_cast<std::uint8_t>(make.number()); })}));
    PowerState power;
    if (make.flag()) power.voltage = make.single();
    if (make.flag()) power.charge = make.single();
    if (make.flag()) power.energy = make.single();
    if (make.flag()) power.power = make.single();
    if (make.flag()) power.charging = static_cast<std::int32_t>(make.number());
    CHECK(survives(power));
  }
}

TEST_CASE("what is written is read again: laser, sonar and ranger", "[hw][player]") {
  Maker make;
  for (int round = 0; round < 200; ++round) {
    CHECK(survives(make.scan()));
    CHECK(survives(SonarRanges{make.list([&] { return make.single(); })}));
    CHECK(survives(SonarGeometry{make.list([&] { return make.pose(); })}));
    CHECK(survives(RangerValues{make.list([&] { return make.real(); })}));
    CHECK(survives(make.ranger_geometry()));
    CHECK(survives(make.ranger_config()));
    RangerStamped stamped{.ranges = {make.list([&] { return make.real(); })}};
    if (make.flag()) stamped.geometry = make.ranger_geometry();
    if (make.flag()) stamped.config = make.ranger_config();
    CHECK(survives(stamped));
  }
}

TEST_CASE("numbers pass bit by bit, even if they are none", "[hw][player]") {
  for (const std::uint64_t bits :
       {0x7FF8000000001234ULL, 0xFFF0000000000000ULL, 0x8000000000000000ULL, 1ULL}) {
    const auto number = std::bit_cast<double>(bits);
    const auto read = decode<Planar>(encode(Planar{.x = number}));
    CHECK(std::bit_cast<std::uint64_t>(read.value().x) == bits);
  }
}
