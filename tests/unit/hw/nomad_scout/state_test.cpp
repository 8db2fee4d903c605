// SPDX-License-Identifier: GPL-3.0-or-later
#include <catch2/catch.hpp>

#include <cmath>
#include <numbers>

#include "orca/base/random.hpp"
#include "orca/hw/nomad_scout/state.hpp"
#include "scout_bytes.hpp"

using namespace orca::hw;
using namespace orca::hw::nomad_scout;
using namespace std::chrono_literals;
using test::Bytes;
using test::HeldMessage;
using test::hex;

namespace {

constexpr double kDegreesOfState = std::numbers::pi / 180.0;

State changed_state(std::size_t offset, const Bytes& bytes) {
  Bytes payload(42);
  std::ranges::copy(bytes, payload.begin() + static_cast<std::ptrdiff_t>(offset));
  return parse_state({Type::get_state, payload}).value();
}

}  // namespace

TEST_CASE("the state of a Scout is read in SI units", "[hw][scout]") {
  const HeldMessage held(hex(test::kStateAnswer));
  const State state = parse_state(held.message).value();
  for (std::size_t i = 0; i < kSonars; ++i)
    CHECK(state.sonars[i] == Approx(0.0254 * static_cast<double>(20 + i)));
  CHECK(state.bumpers == 0);
  CHECK(state.position == RawPosition{122, 6});
  CHECK(state.heading == Approx(5.2 * kDegreesOfState));
  CHECK(state.speeds.right == Approx(0.2667));
  CHECK(state.speeds.left == Approx(0.2413));
  CHECK(state.controller_time == 1712ms);
  CHECK(state.motor_voltage == Approx(11.49).margin(0.005));
}

TEST_CASE("a sonar that hears nothing has an infinite range", "[hw][scout]") {
  const State state = changed_state(3, hex("FF FE 01"));
  CHECK(std::isinf(state.sonars[3]));
  CHECK(state.sonars[4] == Approx(254 * 0.0254));
  CHECK(state.sonars[5] == Approx(0.0254));
}

TEST_CASE("bumpers of a Scout have their low byte first", "[hw][scout]") {
  CHECK(changed_state(16, hex("01 02 80")).bumpers == 0x800201U);
}

TEST_CASE("positions and speeds backward are negative", "[hw][scout]") {
  CHECK(changed_state(19, hex("0A 80 0B 80")).position == RawPosition{-10, -11});
  CHECK(changed_state(27, hex("64 80 32 80")).speeds.right == Approx(-0.254));
  CHECK(changed_state(27, hex("64 80 32 80")).speeds.left == Approx(-0.127));
}

TEST_CASE("headings beyond half a turn are negative", "[hw][scout]") {
  CHECK(changed_state(23, hex("8C 0A")).heading == Approx(-90 * kDegreesOfState));   // 2700
  CHECK(changed_state(23, hex("0F 0E")).heading == Approx(-0.1 * kDegreesOfState));  // 3599
}

TEST_CASE("a NAK is told apart from a state, with what to do", "[hw][scout]") {
  const HeldMessage nak(hex("01 02 00 08 0B 5C"));
  const auto state = parse_state(nak.message);
  REQUIRE_FALSE(state.has_value());
  CHECK(state.error().code == orca::Code::unavailable);
  CHECK(state.error().message == "the robot did not understand the command (NAK); send it again");
}

TEST_CASE("a state of another length is refused", "[hw][scout]") {
  for (const std::size_t size : {0U, 41U, 43U}) {
    const Bytes payload(size);
    CHECK(parse_state({Type::get_state, payload}).error().code == orca::Code::data_loss);
  }
  const Bytes long_state(64);
  CHECK(parse_state({Type::stop, long_state}).error().message ==
        "a state of 64 bytes; that of a Scout has 42: is this another robot, or one with a laser?");
}

TEST_CASE("the state answers the commands of the list, and no others", "[hw][scout]") {
  const Bytes payload(42);
  for (int type = 0; type < 256; ++type) {
    const bool is_listed = std::ranges::count(std::vector<int>{1, 5, 7, 9, 10, 15, 18}, type) == 1;
    INFO(type);
    CHECK(is_answered_by_state(static_cast<Type>(type)) == is_listed);
    CHECK(parse_state({static_cast<Type>(type), payload}).has_value() == is_listed);
  }
}

TEST_CASE("any 42 bytes are a state with finite figures", "[hw][scout]") {
  orca::RandomStream random(1, "test", "scout states");
  for (int round = 0; round < 1000; ++round) {
    Bytes payload(42);
    for (auto& byte : payload) byte = static_cast<std::uint8_t>(random() & 0xFF);
    const State state = parse_state({Type::get_state, payload}).value();
    CHECK(std::abs(state.heading) <= std::numbers::pi);
    CHECK(std::abs(state.position.x) <= 32767);
    CHECK(state.motor_voltage < 12.9);
  }
}
