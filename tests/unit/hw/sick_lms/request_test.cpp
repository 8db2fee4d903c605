// SPDX-License-Identifier: GPL-3.0-or-later
#include <catch2/catch.hpp>

#include <string>

#include "hex_bytes.hpp"
#include "orca/hw/sick_lms/request.hpp"

using namespace orca::hw;
using namespace orca::hw::sick_lms;
using test::Bytes;
using test::hex;

namespace {

std::string wire(const Telegram& telegram) { return test::text_of(telegram.view()); }

// The payload alone, for requests whose check word no page gives.
std::string payload_text(const Telegram& telegram) {
  REQUIRE(look_from_host(telegram.view()).kind == framing::Finding::Kind::frame);
  return test::text_of(payload_of(telegram.view()));
}

}  // namespace

TEST_CASE("requests for information are single bytes", "[hw][sick]") {
  CHECK(wire(request_status()) == "02 00 01 00 31 15 12");
  CHECK(wire(request_type()) == "02 00 01 00 3A 1E 12");
  CHECK(wire(request_configuration()) == "02 00 01 00 74 50 12");
}

TEST_CASE("scans are started and stopped by modes", "[hw][sick]") {
  CHECK(wire(request_mode(Mode::all_scans)) == "02 00 02 00 20 24 34 08");
  CHECK(wire(request_mode(Mode::on_request)) == "02 00 02 00 20 25 35 08");
}

TEST_CASE("rates of the line are modes", "[hw][sick]") {
  CHECK(wire(request_rate(9600).value()) == "02 00 02 00 20 42 52 08");
  CHECK(wire(request_rate(19200).value()) == "02 00 02 00 20 41 51 08");
  CHECK(wire(request_rate(38400).value()) == "02 00 02 00 20 40 50 08");
  CHECK(wire(request_rate(500000).value()) == "02 00 02 00 20 48 58 08");
}

TEST_CASE("a rate that lasers do not have is refused with those they have", "[hw][sick]") {
  const auto refused = request_rate(115200);
  REQUIRE_FALSE(refused.has_value());
  CHECK(refused.error().code == orca::Code::invalid_argument);
  CHECK(refused.error().message == "a laser has no rate of 115200 baud; choose 9600, 19200, 38400 or 500000");
}

TEST_CASE("the installation mode needs the password of the family", "[hw][sick]") {
  CHECK(wire(request_installation(kLmsPassword)) == "02 00 0A 00 20 00 53 49 43 4B 5F 4C 4D 53 BE C5");
  CHECK(payload_text(request_installation(kPlsPassword)) == "20 00 53 49 43 4B 5F 50 4C 53");
}

TEST_CASE("variants are an angle in degrees and a resolution in hundredths", "[hw][sick]") {
  CHECK(wire(request_variant({180, 50})) == "02 00 05 00 3B B4 00 32 00 3B 1F");
  CHECK(wire(request_variant({180, 100})) == "02 00 05 00 3B B4 00 64 00 97 49");
  CHECK(wire(request_variant({100, 25})) == "02 00 05 00 3B 64 00 19 00 E7 72");
  CHECK(wire(request_variant({100, 50})) == "02 00 05 00 3B 64 00 32 00 B1 59");
  CHECK(wire(request_variant({100, 100})) == "02 00 05 00 3B 64 00 64 00 1D 0F");
}

TEST_CASE("a configuration of any length is written as it is", "[hw][sick]") {
  Bytes block(34);
  block[5] = 6;
  block[6] = 1;
  CHECK(wire(write_configuration(block).value()) ==
        "02 00 23 00 77 00 00 00 00 00 06 01 00 00 00 00 00 00 00 00 00 00 00 00 00 00 00 00 00 00 00 00 00 "
        "00 00 00 "
        "00 00 00 AB 70");
  CHECK(wire(write_configuration(hex("00 00 00 00 00 01 01")).value()) ==
        "02 00 08 00 77 00 00 00 00 00 01 01 CD FA");
}

TEST_CASE("a configuration that no telegram can hold is not written", "[hw][sick]") {
  CHECK(write_configuration({}).error().message ==
        "a configuration of 0 bytes cannot be written; read it from the laser first");
  CHECK_FALSE(write_configuration(Bytes(812)).has_value());
  CHECK(write_configuration(Bytes(811)).value().size() == kLongestTelegram);
}
