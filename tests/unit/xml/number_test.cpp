// SPDX-License-Identifier: GPL-3.0-or-later
#include <catch2/catch.hpp>

#include <cmath>
#include <limits>

#include "orca/base/random.hpp"
#include "orca/xml/number.hpp"

using namespace orca::xml;

TEST_CASE("a number has a decimal point, an optional sign and exponent, and blanks around it at most",
          "[xml][number]") {
  CHECK(*parse_number("0.5") == 0.5);
  CHECK(*parse_number(" -1e-3 ") == -0.001);
  CHECK(*parse_number("+.25") == 0.25);
}

TEST_CASE("a text that only starts like a number is refused, and the message shows where the number stops",
          "[xml][number]") {
  const auto error = parse_number("10abc");
  REQUIRE_FALSE(error);
  CHECK(error.error().message == "\"10abc\" is not a number: it stops being one at \"abc\"");
  for (const char* text : {"", " ", "0x10", "1 2", "--1", "+-1", "e5", "one", "1e", "."}) {
    INFO(text);
    CHECK_FALSE(parse_number(text));
  }
}

TEST_CASE("for a decimal comma the error shows the number to write instead", "[xml][number]") {
  const auto error = parse_number("0,25");
  REQUIRE_FALSE(error);
  CHECK(error.error().message == "\"0,25\" is not a number: write a decimal point, \"0.25\"");
  CHECK(parse_leading_number("0,5 m").error().message.find("\"0.5 m\"") != std::string::npos);
}

TEST_CASE("infinity, not-a-number and overflow are refused", "[xml][number]") {
  for (const char* text : {"inf", "-inf", "nan", "infinity", "-nan", "1e999", "-1e999"}) {
    INFO(text);
    CHECK_FALSE(parse_number(text));
  }
  CHECK(parse_number("nan").error().message == "\"nan\" is not a number: it must be finite");
}

TEST_CASE("an integer has digits only and fits in 64 bits", "[xml][number]") {
  CHECK(*parse_integer("-42") == -42);
  CHECK(*parse_integer("9223372036854775807") == std::numeric_limits<std::int64_t>::max());
  for (const char* text : {"", "1.0", "1e3", "0x10", "9223372036854775808", "seven", "5 m", "- 5"}) {
    INFO(text);
    CHECK_FALSE(parse_integer(text));
  }
}

TEST_CASE("numbers of everyday size are printed without powers of ten", "[xml][number]") {
  CHECK(number_text(100000.0) == "100000");
  CHECK(number_text(0.00001) == "0.00001");
  CHECK(number_text(0.0) == "0");
  CHECK(number_text(-0.5) == "-0.5");
  CHECK(number_text(1e20) == "1e+20");
}

TEST_CASE("a printed number reads back as the same value", "[xml][number]") {
  orca::RandomStream random(1, "xml", "number");
  for (int i = 0; i < 2000; ++i) {
    const double value = random.normal(0.0, 1.0) * std::pow(10.0, random.uniform(-200.0, 200.0));
    INFO(number_text(value));
    REQUIRE(*parse_number(number_text(value)) == value);
  }
}
