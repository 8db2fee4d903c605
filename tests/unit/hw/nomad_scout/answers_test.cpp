// SPDX-License-Identifier: GPL-3.0-or-later
#include <catch2/catch.hpp>

#include <numbers>

#include "orca/hw/nomad_scout/answers.hpp"
#include "scout_bytes.hpp"

using namespace orca::hw;
using namespace orca::hw::nomad_scout;
using namespace std::chrono_literals;
using test::Bytes;
using test::HeldMessage;
using test::hex;

TEST_CASE("sonars alone come with the time", "[hw][scout]") {
  const HeldMessage held(
      hex("01 16 00 14 14 15 16 17 18 19 1A 1B 1C 1D 1E 1F 20 21 22 23 E8 07 00 00 D2 5C"));
  const SonarAnswer answer = parse_sonars(held.message).value();
  CHECK(answer.sonars[0] == Approx(0.508));
  CHECK(answer.sonars[15] == Approx(0.889));
  CHECK(answer.controller_time == 2024ms);
}

TEST_CASE("the position alone has four numbers", "[hw][scout]") {
  const HeldMessage held(hex("01 0A 00 15 99 00 09 00 41 00 00 00 03 5C"));
  const PositionAnswer answer = parse_position(held.message).value();
  CHECK(answer.position == RawPosition{153, 9});
  CHECK(answer.heading == Approx(6.5 * std::numbers::pi / 180.0));
  CHECK(answer.turret == 0.0);
}

TEST_CASE("velocities alone have the right wheel first", "[hw][scout]") {
  const HeldMessage held(hex("01 08 00 16 69 00 5F 00 00 00 E7 5C"));
  const Wheels wheels = parse_velocities(held.message).value();
  CHECK(wheels.right == Approx(0.2667));
  CHECK(wheels.left == Approx(0.2413));
}

TEST_CASE("bumpers alone come with the time", "[hw][scout]") {
  const HeldMessage held(hex("01 09 00 1B 00 00 00 E7 07 00 00 13 5C"));
  const BumperAnswer answer = parse_bumpers(held.message).value();
  CHECK(answer.bumpers == 0);
  CHECK(answer.controller_time == 2023ms);
}

TEST_CASE("a program of the user answers with its own bytes", "[hw][scout]") {
  const Bytes payload = hex("02 00 41 42 43");
  CHECK(test::text_of(parse_special({Type::special, payload}).value()) == "41 42");
  const Bytes cut = hex("04 00 41 42 43");
  CHECK_FALSE(parse_special({Type::special, cut}).has_value());
  CHECK_FALSE(parse_special({Type::special, {}}).has_value());
}

TEST_CASE("answers that are cut short or of another type give nothing", "[hw][scout]") {
  const Bytes payload(20);
  for (std::size_t size = 0; size < payload.size(); ++size) {
    const auto cut = std::span(payload).first(size);
    CHECK_FALSE(parse_sonars({Type::get_sonars, cut}).has_value());
    CHECK(parse_position({Type::get_position, cut}).has_value() == (size >= 8));
    CHECK(parse_velocities({Type::get_velocities, cut}).has_value() == (size >= 6));
    CHECK(parse_bumpers({Type::get_bumpers, cut}).has_value() == (size >= 7));
  }
  CHECK(parse_sonars({Type::get_sonars, payload}).has_value());
  CHECK_FALSE(parse_sonars({Type::get_position, payload}).has_value());
  CHECK_FALSE(parse_position({Type::nak, payload}).has_value());
  CHECK_FALSE(parse_velocities({Type::get_accelerations, payload}).has_value());
  CHECK_FALSE(parse_bumpers({Type::get_sonars, payload}).has_value());
}
