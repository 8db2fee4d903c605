// SPDX-License-Identifier: GPL-3.0-or-later
#include <catch2/catch.hpp>

#include <numbers>

#include "orca/xml/quantity.hpp"
#include "orca/xml/values.hpp"

using namespace orca::xml;
using namespace std::chrono_literals;

TEST_CASE("a quantity is converted to SI without rounding where the decimal allows it", "[xml][quantity]") {
  CHECK(*parse_quantity("190 mm", "m") == 0.19);
  CHECK(*parse_quantity("19cm", "m") == 0.19);
  CHECK(*parse_quantity("50 ms", "s") == 0.05);
  CHECK(*parse_quantity("22.5 deg", "rad") == 22.5 * std::numbers::pi / 180.0);
  CHECK(*parse_quantity("10 Hz", "Hz") == 10.0);
  CHECK(*parse_quantity("36 km/h", "m/s") == 10.0);
  CHECK(*parse_quantity("180 deg/s", "rad/s") == std::numbers::pi);
  CHECK(*parse_quantity("0.5 m/s2", "m/s2") == 0.5);
  CHECK(*parse_quantity("250 g", "kg") == 0.25);
  CHECK(*parse_quantity("35 %", "") == 0.35);
}

TEST_CASE("an amount of memory is in bytes, with decimal or binary multiples", "[xml][quantity]") {
  CHECK(*parse_quantity("200 MB", "B") == 200e6);
  CHECK(*parse_quantity("64 kB", "B") == 64e3);
  CHECK(*parse_quantity("1.5 GB", "B") == 1.5e9);
  CHECK(*parse_quantity("8 KiB", "B") == 8192);
  CHECK(*parse_quantity("2MiB", "B") == 2097152);
  CHECK(*parse_quantity("0.5 GiB", "B") == 536870912);
  CHECK(*parse_quantity("4096", "B") == 4096);
  CHECK(parse_quantity("2 m", "B").error().message ==
        "\"2 m\": \"m\" measures a length; an amount of memory is expected: write B, kB, MB, GB, KiB, MiB or "
        "GiB");
}

TEST_CASE("a bare number is in SI already", "[xml][quantity]") {
  CHECK(*parse_quantity("0.5", "m") == 0.5);
  CHECK(*parse_quantity("0.5", "") == 0.5);
}

TEST_CASE("a unit of another quantity is refused with what may be written", "[xml][quantity]") {
  const auto mass = parse_quantity("2 kg", "m");
  REQUIRE_FALSE(mass);
  CHECK(mass.error().message ==
        "\"2 kg\": \"kg\" measures a mass; a length is expected: write m, mm, cm or km");
  CHECK(parse_quantity("2 m", "").error().message ==
        "\"2 m\": \"m\" measures a length; a plain number is expected: write none, or % for hundredths");
}

TEST_CASE("an unknown unit is refused, unless it is exactly the expected one", "[xml][quantity]") {
  CHECK(parse_quantity("3 ft", "m").error().message.find("\"ft\" is not a unit that Orca knows") !=
        std::string::npos);
  CHECK(*parse_quantity("3 1/m", "1/m") == 3.0);
  CHECK(parse_quantity("3 m", "1/m").error().message.find("a value in 1/m is expected: write 1/m") !=
        std::string::npos);
}

TEST_CASE("a value that overflows in SI is refused", "[xml][quantity]") {
  CHECK_FALSE(parse_quantity("1.7e308 km", "m"));
}

TEST_CASE("a number is read together with what it measures", "[xml][quantity]") {
  CHECK(parse_measured("190 mm")->value == 0.19);
  CHECK(parse_measured("190 mm")->si == "m");
  CHECK(parse_measured("0.5")->si.empty());
  CHECK(parse_measured("20 %")->value == 0.2);
  CHECK(parse_measured("20 %")->si.empty());
  CHECK(parse_measured("3 ft").error().message == "\"3 ft\": \"ft\" is not a unit that Orca knows");
  CHECK_FALSE(parse_measured("soon"));
  CHECK_FALSE(parse_measured("1.7e308 km"));
}

TEST_CASE("a duration is a time with or without a blank before the unit", "[xml][quantity]") {
  CHECK(*parse_duration("60s") == 60s);
  CHECK(*parse_duration("60 s") == 60s);
  CHECK(*parse_duration("1.5") == 1500ms);
  CHECK(*parse_duration("50 ms") == 50ms);
  CHECK(*parse_duration("2 min") == 120s);
}

TEST_CASE("a duration is neither negative nor endless nor something else than a time", "[xml][quantity]") {
  for (const char* text : {"-1 s", "1e30 s", "200 m", "soon", ""}) {
    INFO(text);
    CHECK_FALSE(parse_duration(text));
  }
}

TEST_CASE("a time that no counter of nanoseconds holds is out of range, whatever its rule allows",
          "[xml][quantity]") {
  const ValueRule seconds{.form = ValueRule::Form::number, .unit = "s", .min = 0.0};
  ValueFault fault;
  CHECK(read_number("3.1e9 s", seconds, fault) == 3.1e9);
  CHECK_FALSE(read_number("1e300", seconds, fault));
  CHECK(fault.kind == ValueFault::Kind::range);
  CHECK_THAT(fault.message, Catch::Contains("\"1e300\" is out of range: a time of at most a hundred years"));
  const ValueRule metres{.form = ValueRule::Form::number, .unit = "m"};
  CHECK(read_number("1e300", metres, fault) == 1e300);
}
