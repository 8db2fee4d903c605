// SPDX-License-Identifier: GPL-3.0-or-later
#include <catch2/catch.hpp>

#include "hex_bytes.hpp"
#include "orca/hw/sick_lms/configuration.hpp"

using namespace orca::hw;
using sick_lms::Configuration;
using sick_lms::Unit;
using test::Bytes;
using test::hex;

namespace {

// As one program was seen to write it: 70 cm blanking, no thresholds, dazzling, mode 1, millimetres.
Bytes block() { return hex("46 00 07 02 05 01 01 00 02 02 00 AA"); }

}  // namespace

TEST_CASE("the settings of a laser are read from its configuration", "[hw][sick]") {
  const Configuration configuration = Configuration::of(block()).value();
  CHECK(configuration.blanking() == 70);
  CHECK(configuration.stop_threshold() == 7);
  CHECK(configuration.peak_threshold() == 2);
  CHECK(configuration.availability() == 5);
  CHECK(configuration.measuring_mode() == 1);
  CHECK(configuration.unit() == Unit::millimetre);
}

TEST_CASE("setting one thing leaves all other bytes as they were read", "[hw][sick]") {
  Configuration configuration = Configuration::of(block()).value();
  CHECK(configuration.set_measuring_mode(6).ok());
  CHECK(test::text_of(configuration.bytes()) == "46 00 07 02 05 06 01 00 02 02 00 AA");
  CHECK(configuration.set_unit(Unit::centimetre).ok());
  CHECK(configuration.set_availability(1).ok());
  CHECK(configuration.set_peak_threshold(3).ok());
  CHECK(test::text_of(configuration.bytes()) == "46 00 07 03 01 06 00 00 02 02 00 AA");
}

TEST_CASE("a configuration keeps its length, whatever it is", "[hw][sick]") {
  for (std::size_t size = 0; size <= Configuration::kMostBytes; ++size) {
    const Bytes bytes(size, 0x5A);
    REQUIRE(Configuration::of(bytes).value().bytes().size() == size);
  }
  CHECK(Configuration::of(Bytes(Configuration::kMostBytes + 1)).error().code == orca::Code::data_loss);
}

TEST_CASE("a setting that the block does not reach is absent and cannot be set", "[hw][sick]") {
  Configuration configuration = Configuration::of(hex("01")).value();
  CHECK_FALSE(configuration.blanking().has_value());
  CHECK_FALSE(configuration.measuring_mode().has_value());
  CHECK_FALSE(configuration.unit().has_value());
  const orca::Status refused = configuration.set_measuring_mode(6);
  REQUIRE_FALSE(refused.ok());
  CHECK(refused.error().code == orca::Code::failed_precondition);
  CHECK(refused.error().message ==
        "the laser's configuration has 1 bytes and no byte 5; this laser does not have the setting");
  CHECK(test::text_of(configuration.bytes()) == "01");
}
