// SPDX-License-Identifier: GPL-3.0-or-later
#include <catch2/catch.hpp>

#include "hex_bytes.hpp"
#include "orca/hw/rplidar/request.hpp"
#include "orca/hw/rplidar/response.hpp"

using namespace orca::hw::rplidar;
using orca::hw::test::hex;
using orca::hw::test::text_of;

TEST_CASE("descriptors are those of the manual", "[hw][rplidar]") {
  const std::vector<std::pair<DataType, std::string>> known{{DataType::info, "A5 5A 14 00 00 00 04"},
                                                            {DataType::health, "A5 5A 03 00 00 00 06"},
                                                            {DataType::sample_rates, "A5 5A 04 00 00 00 15"},
                                                            {DataType::nodes, "A5 5A 05 00 00 40 81"},
                                                            {DataType::capsules, "A5 5A 54 00 00 40 82"}};
  for (const auto& [type, bytes] : known) {
    CHECK(text_of(make_descriptor(type)) == bytes);
    CHECK(parse_descriptor(hex(bytes)) == type);
  }
}

TEST_CASE("a descriptor with another size, mode or type is none", "[hw][rplidar]") {
  for (const std::string wrong :
       {"A5 5B 14 00 00 00 04", "A5 5A 15 00 00 00 04", "A5 5A 14 01 00 00 04", "A5 5A 14 00 00 40 04",
        "A5 5A 05 00 00 00 81", "A5 5A 84 00 00 40 84", "A5 5A 14 00 00 00", "A5 5A 14 00 00 00 04 00", ""})
    CHECK_FALSE(parse_descriptor(hex(wrong)).has_value());
}

TEST_CASE("the information about a scanner has the minor number of the firmware first", "[hw][rplidar]") {
  const DeviceInfo info = parse_info(hex("18 1D 01 07 A4 E1 9A F0 C1 E3 9E D4 B1 98 4C 95 1C 28 42 13"));
  CHECK(info.model == 0x18);
  CHECK(info.firmware_major == 1);
  CHECK(info.firmware_minor == 29);
  CHECK(info.hardware == 7);
  CHECK(info.serial_text() == "A4E19AF0C1E39ED4B1984C951C284213");
}

TEST_CASE("health is a state and an error number", "[hw][rplidar]") {
  CHECK(parse_health(hex("00 00 00")) == Health{});
  CHECK(parse_health(hex("01 00 00")).state == Health::State::warning);
  CHECK(parse_health(hex("02 01 80")) == Health{Health::State::error, 0x8001});
}

TEST_CASE("sample rates are times in microseconds", "[hw][rplidar]") {
  const SampleRates rates = parse_sample_rates(hex("F4 01 FA 00"));
  CHECK(rates.scan == Approx(500e-6));
  CHECK(rates.express_scan == Approx(250e-6));
}

TEST_CASE("requests without arguments are two bytes", "[hw][rplidar]") {
  CHECK(text_of(encode(Request::stop).view()) == "A5 25");
  CHECK(text_of(encode(Request::reset).view()) == "A5 40");
  CHECK(text_of(encode(Request::scan).view()) == "A5 20");
  CHECK(text_of(encode(Request::info).view()) == "A5 50");
  CHECK(text_of(encode(Request::health).view()) == "A5 52");
  CHECK(text_of(encode(Request::sample_rates).view()) == "A5 59");
}

TEST_CASE("an express scan has five arguments and the exclusive or of all bytes", "[hw][rplidar]") {
  CHECK(text_of(encode(Request::express_scan).view()) == "A5 82 05 00 00 00 00 00 22");
}
