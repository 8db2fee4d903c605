// SPDX-License-Identifier: GPL-3.0-or-later
// The text form of a byte log, as orca/hw/link/byte_record.hpp describes it.
#include <catch2/catch.hpp>

#include "link_talk.hpp"
#include "orca/hw/link/byte_record.hpp"

using namespace orca;
using namespace orca::test;
using Catch::Contains;
using hw::link::ByteRecord;
using hw::link::read_byte_log;
using Kind = ByteRecord::Kind;

namespace {

Error error_of_log(const std::string& lines) {
  const Result<std::vector<ByteRecord>> records = read_byte_log("# orca byte log 1\n" + lines);
  if (records) FAIL("it is read: " << lines);
  return records.error();
}

}  // namespace

TEST_CASE("a byte log is read line by line", "[hw][link][log]") {
  const auto records = read_byte_log(
      "# orca byte log 1\n"
      "# serial:/dev/ttyUSB0\n"
      "0.000000 open\n"
      "0.000214 out  fa fb 03 00 00 00\n"
      "0.014871 in   FA fb\n"
      "\n"
      "12.500000 dropped 00\n"
      "12.500000 gone the device has gone\n"
      "12.500001 close\n"
      "100.000000 full the limit\n");
  REQUIRE(records.has_value());
  CHECK(*records == std::vector<ByteRecord>{{0s, Kind::open, {}, {}},
                                            {214us, Kind::out, {0xFA, 0xFB, 3, 0, 0, 0}, {}},
                                            {14871us, Kind::in, {0xFA, 0xFB}, {}},
                                            {12500ms, Kind::dropped, {0}, {}},
                                            {12500ms, Kind::gone, {}, "the device has gone"},
                                            {12500001us, Kind::close, {}, {}},
                                            {100s, Kind::full, {}, "the limit"}});
}

TEST_CASE("records are written as people read them", "[hw][link][log]") {
  CHECK(hw::link::to_lines({0s, Kind::open, {}, {}}) == "0.000000 open\n");
  CHECK(hw::link::to_lines({214us, Kind::out, {0xFA, 0x0B}, {}}) == "0.000214 out  fa 0b\n");
  CHECK(hw::link::to_lines({61s + 9ms, Kind::in, {0}, {}}) == "61.009000 in   00\n");
  CHECK(hw::link::to_lines({1s, Kind::gone, {}, "un\nplugged"}) == "1.000000 gone un\\nplugged\n");
}

TEST_CASE("many bytes take several lines of one time, and nothing of them is lost", "[hw][link][log]") {
  Bytes bytes(70, 0xAB);
  bytes.back() = 0xCD;
  const std::string lines = hw::link::to_lines({2s, Kind::in, bytes, {}});
  const auto records = read_byte_log("# orca byte log 1\n" + lines);
  REQUIRE(records.has_value());
  REQUIRE(records->size() == 3);
  Bytes again;
  for (const ByteRecord& record : *records) {
    CHECK(record.time == 2s);
    again.insert(again.end(), record.bytes.begin(), record.bytes.end());
  }
  CHECK(again == bytes);
}

TEST_CASE("a last line that was cut does not count", "[hw][link][log]") {
  const auto records = read_byte_log("# orca byte log 1\n0.000000 open\n0.000100 in   fa f");
  REQUIRE(records.has_value());
  CHECK(records->size() == 1);
}

TEST_CASE("what is no byte log is refused with the place and the reason", "[hw][link][log]") {
  CHECK_THAT(read_byte_log("<graph>\n").error().text(), Contains("line 1: this is no byte log"));
  CHECK_THAT(read_byte_log("<graph>").error().text(), Contains("not one whole line"));
  CHECK_THAT(error_of_log("0.000000 open\n1.5 in fa\n").text(), Contains("line 3: \"1.5\" is no time"));
  for (const char* time :
       {"-1.000000", ".000000", "1.0000000", "1,000000", "1e3", "nan", "9999999999.000000", "1.00000x"})
    CHECK_THAT(error_of_log(std::string(time) + " open\n").message, Contains("is no time"));
  CHECK_THAT(error_of_log("0.000000 inn fa\n").message,
             Contains("\"inn\" is no word") && Contains("open, in, dropped, out, gone, close, full"));
  CHECK_THAT(error_of_log("0.000000\n").message, Contains("\"\" is no word"));
  for (const char* byte : {"f", "fff", "g0", "0x", "-1"})
    CHECK_THAT(error_of_log("0.000000 in " + std::string(byte) + "\n").message,
               Contains("\"" + std::string(byte) + "\" is no byte"));
  CHECK_THAT(error_of_log("0.000000 in\n").message, Contains("no bytes"));
  CHECK_THAT(error_of_log("0.000000 open fa\n").message, Contains("nothing belongs"));
  CHECK_THAT(error_of_log("1.000000 open\n0.999999 close\n").text(), Contains("line 3: the time is earlier"));
  CHECK_THAT(error_of_log("1.000000 full x\n1.000000 close\n").message, Contains("last one"));
}
