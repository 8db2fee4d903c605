// SPDX-License-Identifier: GPL-3.0-or-later
#include <catch2/catch.hpp>

#include <vector>

#include "orca/hw/sick_lms/measuring_mode.hpp"

using namespace orca::hw::sick_lms;

TEST_CASE("measuring modes have the masks of the telegram listing", "[hw][sick]") {
  struct Row {
    std::uint8_t mode;
    std::uint16_t mask;
    bool has_level;
  };
  for (const Row& row : std::vector<Row>{{0x00, 0x1FFF, false},
                                         {0x01, 0x1FFF, true},
                                         {0x02, 0x1FFF, false},
                                         {0x03, 0x3FFF, true},
                                         {0x04, 0x3FFF, false},
                                         {0x05, 0x7FFF, true},
                                         {0x06, 0x7FFF, false},
                                         {0x0F, 0xFFFF, false},
                                         {0x3F, 0x0000, false}}) {
    INFO(int{row.mode});
    CHECK(layout_of(row.mode).value().distance_mask == row.mask);
    CHECK(layout_of(row.mode).value().has_reflector_level == row.has_level);
  }
  CHECK_FALSE(layout_of(0x3F).value().is_distance());
}

TEST_CASE("all other measuring modes are unknown", "[hw][sick]") {
  for (int mode = 0; mode < 256; ++mode) {
    const bool is_known = mode <= 6 || mode == 0x0F || mode == 0x3F;
    INFO(mode);
    CHECK(layout_of(static_cast<std::uint8_t>(mode)).has_value() == is_known);
  }
}

TEST_CASE("the codes at the end of each range mean that nothing came back", "[hw][sick]") {
  const ValueLayout near = layout_of(0).value();
  for (const int code : {0x1FFF, 0x1FFE, 0x1FFD, 0x1FFB, 0x1FFA, 0x1FF7})
    CHECK(near.is_no_return(static_cast<std::uint16_t>(code)));
  CHECK_FALSE(near.is_no_return(0x1FF6));
  CHECK_FALSE(near.is_no_return(0));
  CHECK(layout_of(3).value().is_no_return(0x3FF7));
  CHECK_FALSE(layout_of(3).value().is_no_return(0x1FFF));
  CHECK(layout_of(6).value().is_no_return(0x7FF7));
  CHECK_FALSE(layout_of(6).value().is_no_return(32000));
  CHECK(layout_of(0x0F).value().is_no_return(0x7FFF));
  CHECK_FALSE(layout_of(0x0F).value().is_no_return(32000));
}

TEST_CASE("the bits above the distance are given from bit 0", "[hw][sick]") {
  CHECK(layout_of(0).value().flags(0x2001) == 1);
  CHECK(layout_of(1).value().flags(0xFFFF) == 7);
  CHECK(layout_of(4).value().flags(0x8001) == 2);
  CHECK(layout_of(6).value().flags(0x8001) == 1);
  CHECK(layout_of(0x0F).value().flags(0xFFFF) == 0);
}

TEST_CASE("units are centimetres, millimetres and decimetres", "[hw][sick]") {
  CHECK(metres(Unit::centimetre) == 0.01);
  CHECK(metres(Unit::millimetre) == 0.001);
  CHECK(metres(Unit::decimetre) == 0.1);
}
