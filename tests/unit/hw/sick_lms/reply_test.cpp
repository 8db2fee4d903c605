// SPDX-License-Identifier: GPL-3.0-or-later
#include <catch2/catch.hpp>

#include "hex_bytes.hpp"
#include "laser_bytes.hpp"
#include "orca/hw/sick_lms/reply.hpp"

using namespace orca::hw;
using namespace orca::hw::sick_lms;
using sick_lms::Configuration;
using sick_lms::Unit;
using test::Bytes;
using test::HeldReply;
using test::hex;

namespace {

// As one program was seen to write it: 70 cm blanking, no thresholds, dazzling, mode 1, millimetres.
Bytes block() { return hex("46 00 07 02 05 01 01 00 02 02 00 AA"); }

}  // namespace

TEST_CASE("the answer to a mode says whether it was chosen", "[hw][sick]") {
  CHECK(parse_mode_answer(HeldReply(hex("02 80 03 00 A0 00 10 16 0A")).reply) == ModeAnswer::success);
  CHECK(parse_mode_answer(HeldReply(hex("02 80 03 00 A0 01 10 14 0B")).reply) == ModeAnswer::refused);
  CHECK(parse_mode_answer(HeldReply(test::from_laser(hex("A0 02 10"))).reply) == ModeAnswer::fault);
  CHECK(parse_mode_answer(HeldReply(test::from_laser(hex("A0 77 10"))).reply) == ModeAnswer::unknown);
  CHECK_FALSE(parse_mode_answer(HeldReply(test::from_laser(hex("A0 10"))).reply).has_value());
}

TEST_CASE("the status byte is the last of each payload", "[hw][sick]") {
  const HeldReply good(hex("02 80 03 00 A0 00 10 16 0A"));
  CHECK(good.reply.status.byte == 0x10);
  CHECK(good.reply.status.is_good());
  CHECK_FALSE(good.reply.status.is_polluted());
  const StatusByte bad{0xE3};
  CHECK(bad.severity() == 3);
  CHECK_FALSE(bad.is_good());
  CHECK(bad.has_implausible_values());
  CHECK(bad.is_polluted());
}

TEST_CASE("the answer to a variant gives the one that the laser has now", "[hw][sick]") {
  CHECK(parse_variant(HeldReply(hex("02 80 07 00 BB 01 B4 00 32 00 10 03 9D")).reply) ==
        VariantAnswer{true, {180, 50}});
  CHECK(parse_variant(HeldReply(hex("02 80 07 00 BB 01 B4 00 64 00 10 5B 30")).reply) ==
        VariantAnswer{true, {180, 100}});
  CHECK(parse_variant(HeldReply(test::from_laser(hex("BB 00 64 00 19 00 10"))).reply) ==
        VariantAnswer{false, {100, 25}});
  CHECK_FALSE(parse_variant(HeldReply(test::from_laser(hex("BB 01 B4 00 10"))).reply).has_value());
}

TEST_CASE("a request that is not accepted has an answer of its own", "[hw][sick]") {
  const HeldReply held(hex("02 80 02 00 92 10 7F 33"));
  CHECK(held.reply.code == ReplyCode::not_accepted);
  CHECK(held.reply.data.empty());
  CHECK_FALSE(parse_mode_answer(held.reply).has_value());
}

TEST_CASE("the type is a text without the blank at its end", "[hw][sick]") {
  const HeldReply type(
      hex("02 80 16 00 BA 4C 4D 53 32 30 30 3B 33 30 31 30 36 3B 56 30 32 2E 33 30 20 10 89 A3"));
  CHECK(type.reply.code == ReplyCode::type);
  CHECK(parse_type(type.reply) == "LMS200;30106;V02.30");
  CHECK(parse_type(HeldReply(test::from_laser(hex("BA 20 00 20 10"))).reply) == "");
  CHECK_FALSE(parse_type(HeldReply(test::from_laser(hex("91 10"))).reply).has_value());
}

TEST_CASE("a configuration is all that lies between code and status", "[hw][sick]") {
  const HeldReply held(
      hex("02 80 24 00 F4 00 00 00 00 00 06 01 00 00 00 00 00 00 00 00 00 00 00 00 00 00 00 00 00 00 00 00 "
          "00 00 00 "
          "00 00 00 00 10 4D 8A"));
  const Configuration configuration = parse_configuration(held.reply).value();
  CHECK(configuration.bytes().size() == 34);
  CHECK(configuration.measuring_mode() == 6);
  CHECK(configuration.unit() == Unit::millimetre);
}

TEST_CASE("configurations of other firmware are shorter", "[hw][sick]") {
  for (const std::size_t size : {30U, 32U, 34U}) {
    const HeldReply held(test::from_laser(test::joined({hex("F4"), Bytes(size, 0x01), hex("10")})));
    CHECK(held.telegram.size() == size + 8);
    CHECK(parse_configuration(held.reply).value().bytes().size() == size);
  }
}

TEST_CASE("the answer to writing has a byte before the configuration", "[hw][sick]") {
  const HeldReply held(test::from_laser(hex("F7 01 00 00 00 00 00 06 01 10")));
  const WriteAnswer answer = parse_written(held.reply).value();
  CHECK(answer.is_accepted);
  CHECK(test::text_of(answer.configuration.bytes()) == "00 00 00 00 00 06 01");
  CHECK_FALSE(parse_written(HeldReply(test::from_laser(hex("F7 00 00 10"))).reply).value().is_accepted);
  CHECK_FALSE(parse_written(HeldReply(test::from_laser(hex("F7 10"))).reply).has_value());
  CHECK_FALSE(parse_configuration(held.reply).has_value());
}

TEST_CASE("scans that come before an awaited answer are told apart by their code", "[hw][sick]") {
  test::FrameList list(kFromLaser);
  list.hear(hex("02 80 0E 00 B0 05 40 E8 03 D0 07 B8 0B A0 0F 88 13 10 F6 F2 06 02 80 03 00 A0 00 10 16 0A"));
  REQUIRE(list.frames().size() == 3);
  CHECK_FALSE(parse_mode_answer(HeldReply(hex(list.frames()[0])).reply).has_value());
  CHECK(parse_mode_answer(HeldReply(hex(list.frames()[2])).reply) == ModeAnswer::success);
}

TEST_CASE("a payload without code and status is no reply", "[hw][sick]") {
  CHECK_FALSE(parse_reply({}).has_value());
  CHECK_FALSE(parse_reply(hex("A0")).has_value());
}

TEST_CASE("the settings of a laser are read from its configuration", "[hw][sick]") {
  const Configuration configuration = Configuration::of(block()).value();
  CHECK(configuration.measuring_mode() == 1);
  CHECK(configuration.unit() == Unit::millimetre);
}

TEST_CASE("setting one thing leaves all other bytes as they were read", "[hw][sick]") {
  Configuration configuration = Configuration::of(block()).value();
  CHECK(configuration.set_measuring_mode(6).ok());
  CHECK(test::text_of(configuration.bytes()) == "46 00 07 02 05 06 01 00 02 02 00 AA");
  CHECK(configuration.set_unit(Unit::centimetre).ok());
  CHECK(test::text_of(configuration.bytes()) == "46 00 07 02 05 06 00 00 02 02 00 AA");
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
  CHECK_FALSE(configuration.measuring_mode().has_value());
  CHECK_FALSE(configuration.unit().has_value());
  const orca::Status refused = configuration.set_measuring_mode(6);
  REQUIRE_FALSE(refused.ok());
  CHECK(refused.error().code == orca::Code::failed_precondition);
  CHECK(refused.error().message ==
        "the laser's configuration has 1 bytes and no byte 5; this laser does not have the setting");
  CHECK(test::text_of(configuration.bytes()) == "01");
}
