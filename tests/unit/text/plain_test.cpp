// SPDX-License-Identifier: GPL-3.0-or-later
#include <catch2/catch.hpp>

#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>

#include "orca/base/random.hpp"
#include "orca/idl/navigation.hpp"
#include "orca/idl/sensing.hpp"
#include "orca/idl/system.hpp"
#include "reading.hpp"
#include "slow_run.hpp"

using namespace orca;
using namespace std::string_literals;
using orca::test::read;
using orca::test::reading;
using orca::test::written;

namespace {

std::string voltage_text(double value) {
  idl::Battery battery;
  battery.voltage(value);
  const std::string text = written(battery);
  const std::size_t start = text.find("voltage=\"") + 9;
  return text.substr(start, text.find('"', start) - start);
}

std::uint64_t bits(double value) { return std::bit_cast<std::uint64_t>(value); }

double round_trip(double value) {
  idl::Battery battery;
  battery.voltage(value);
  return read<idl::Battery>(written(battery)).voltage();
}

std::string round_trip(const std::string& text) {
  idl::Ask ask;
  ask.about(text);
  return read<idl::Ask>(written(ask)).about();
}

std::string about_text(const std::string& about) {
  idl::Ask ask;
  ask.about(about);
  const std::string text = written(ask);
  const std::size_t start = text.find("about=\"") + 7;
  return text.substr(start, text.find('"', start) - start);
}

std::int64_t ns_of(const std::string& stamp) {
  return read<idl::Arrived>("<Arrived stamp=\"" + stamp + "\"/>").stamp().ns();
}

}  // namespace

TEST_CASE("any 64 bits of a double come back", "[text][number]") {
  RandomStream random(20, "test", "doubles");
  for (int i = 0; i < orca::test::part_of(20'000); ++i) {
    const auto value = std::bit_cast<double>(random());
    REQUIRE(bits(round_trip(value)) == bits(value));
  }
}

TEST_CASE("the doubles at the edges come back", "[text][number]") {
  using Limits = std::numeric_limits<double>;
  for (const double value : {0.0, -0.0, Limits::denorm_min(), -Limits::denorm_min(), Limits::min(),
                             std::nextafter(Limits::min(), 0.0), Limits::max(), Limits::lowest(),
                             Limits::epsilon(), Limits::infinity(), -Limits::infinity(), Limits::quiet_NaN(),
                             -Limits::quiet_NaN(), Limits::signaling_NaN(), 0.1, 1e15, 1e-6}) {
    CHECK(bits(round_trip(value)) == bits(value));
  }
}

TEST_CASE("numbers that are not finite are written inf, -inf and nan, and any other NaN with its bits",
          "[text][number]") {
  const double infinity = std::numeric_limits<double>::infinity();
  CHECK(voltage_text(infinity) == "inf");
  CHECK(voltage_text(-infinity) == "-inf");
  CHECK(voltage_text(std::numeric_limits<double>::quiet_NaN()) == "nan");
  CHECK(voltage_text(std::bit_cast<double>(0xfff8000000000001ULL)) == "nan(fff8000000000001)");
  CHECK(read<idl::Battery>("<Battery voltage='+inf V'/>").voltage() == infinity);
}

TEST_CASE("a nan with the bits of a number is refused", "[text][number]") {
  for (const char* text :
       {"nan(0)", "nan()", "nan(7ff8", "nan(7ff0000000000000)", "nan(12345678123456789)", "nanny"}) {
    CHECK_THAT(reading("<Battery voltage='"s + text + "'/>").errors, Catch::Contains("is not a number"));
  }
}

TEST_CASE("every byte comes back in a text, whatever characters it makes", "[text][characters]") {
  std::string all;
  for (int c = 0; c < 256; ++c) all += static_cast<char>(c);
  CHECK(round_trip(all) == all);
  for (const std::string& text :
       {""s, " leading and trailing "s, "a\nb\r\nc\td"s, "\"<&>'"s, "]]>"s, "C:\\x41\\"s, "\0hidden\0"s,
        "Gr\xc3\xb6\xc3\x9f"
        "e \xe2\x82\xac \xf0\x9f\xa4\x96"s,
        "\xc3"s, "\xff\xfe"s, "\xed\xa0\x80"s, "\xf4\x90\x80\x80"s, "\xef\xbf\xbe"s, "\x7f\x1b[31m"s,
        "&#10;&amp;"s}) {
    CHECK(round_trip(text) == text);
  }
}

TEST_CASE("bytes that XML cannot hold are written as \\x and two digits, a backslash twice",
          "[text][characters]") {
  CHECK(about_text("a\x1b"
                   "b\\c") == "a\\x1bb\\\\c");
  CHECK(about_text("\xc3\x28") == "\\xc3(");
  CHECK(about_text("Gr\xc3\xb6\xc3\x9f"
                   "e") ==
        "Gr\xc3\xb6\xc3\x9f"
        "e");
  CHECK(read<idl::Ask>("<Ask about='\\x4F\\\\x41'/>").about() == "O\\x41");
}

TEST_CASE("integers outside the range of their type are refused", "[text][integer]") {
  CHECK(read<idl::Ask>("<Ask seq='18446744073709551615'/>").seq() == UINT64_MAX);
  CHECK(read<idl::Ask>("<Ask seq=' +7 '/>").seq() == 7);
  CHECK(read<idl::BumperReadings>("<BumperReadings pressed='0 255'/>").pressed()[1] == 255);
  CHECK(reading("<BumperReadings pressed='0 256'/>").errors ==
        "x:1:26: error T008: <BumperReadings>: pressed: value 2: \"256\" is not between 0 and 255\n");
  CHECK(reading("<Ask seq='-1'/>").errors ==
        "x:1:11: error T008: <Ask>: seq: \"-1\" is not between 0 and 18446744073709551615\n");
  for (const char* text : {"", " ", "+", "1.0", "1e3", "0x10", "1 2", "7 m", "++1"}) {
    CHECK_THAT(reading("<Ask seq='"s + text + "'/>").errors, Catch::Contains("is not a whole number"));
  }
}

TEST_CASE("an instant is written in seconds and comes back to the nanosecond", "[text][instant]") {
  for (const std::int64_t ns :
       std::initializer_list<std::int64_t>{0, 1, -1, 999'999'999, 1'000'000'000, -1'500'000'000,
                                           1'700'000'000'123'456'789, INT64_MAX, INT64_MIN}) {
    idl::Arrived arrived;
    arrived.stamp().ns(ns);
    CHECK(read<idl::Arrived>(written(arrived)).stamp().ns() == ns);
  }
  idl::Arrived arrived;
  arrived.stamp().ns(-12'050'000'001);
  CHECK_THAT(written(arrived), Catch::Contains("stamp=\"-12.050000001\""));
}

TEST_CASE("an instant may be typed with a unit of time", "[text][instant]") {
  CHECK(ns_of("12") == 12'000'000'000);
  CHECK(ns_of(" +12.5 s ") == 12'500'000'000);
  CHECK(ns_of("12.5s") == 12'500'000'000);
  CHECK(ns_of("50 ms") == 50'000'000);
  CHECK(ns_of("-3 us") == -3'000);
  CHECK(ns_of("2 min") == 120'000'000'000);
  CHECK(ns_of("1e3") == 1'000'000'000'000);
  CHECK(ns_of(".5") == 500'000'000);
  CHECK(ns_of("0.0000000016") == 2);
}

TEST_CASE("an instant that does not exist is refused", "[text][instant]") {
  const auto errors = [](const std::string& stamp) {
    return reading("<Arrived stamp='" + stamp + "'/>").errors;
  };
  CHECK_THAT(errors("9223372036.854775808"), Catch::Contains("T008") && Catch::Contains("292 years"));
  CHECK_THAT(errors("1e300"), Catch::Contains("292 years"));
  CHECK_THAT(errors("nan"), Catch::Contains("292 years"));
  CHECK_THAT(errors("-inf"), Catch::Contains("292 years"));
  CHECK_THAT(errors("3 m"), Catch::Contains("T007") && Catch::Contains("a time is expected"));
  CHECK_THAT(errors("soon"), Catch::Contains("T006"));
  CHECK_THAT(errors("1.2.3"), Catch::Contains("T007"));
  CHECK_THAT(errors(""), Catch::Contains("T006"));
}
