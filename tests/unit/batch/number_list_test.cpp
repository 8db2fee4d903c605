// SPDX-License-Identifier: GPL-3.0-or-later
#include "experiment/number_list.hpp"

#include <catch2/catch.hpp>

using Catch::Contains;
using orca::batch::read_number_list;

TEST_CASE("numbers and ranges are read in the order of the text", "[batch]") {
  const std::vector<std::uint64_t> expected{3, 1, 2, 18446744073709551615U};
  CHECK(read_number_list("3 1-2 18446744073709551615").value() == expected);
  CHECK(read_number_list(" 7 ").value() == std::vector<std::uint64_t>{7});
}

TEST_CASE("what is no list of numbers is refused with what to write", "[batch]") {
  const auto text_of = [](const char* list) { return read_number_list(list).error().message; };
  CHECK_THAT(text_of(""), Contains("there is no number"));
  CHECK_THAT(text_of("1,2"), Contains("\"1,2\" is neither a number nor a range; write for example 1-20 50"));
  CHECK_THAT(text_of("-1"), Contains("neither a number nor a range"));
  CHECK_THAT(text_of("18446744073709551616"), Contains("neither a number nor a range"));
  CHECK_THAT(text_of("5-1"), Contains("goes down"));
  CHECK_THAT(text_of("1-5 3"), Contains("3 is given twice"));
  CHECK_THAT(text_of("0-1000000"), Contains("more than 1,000,000 numbers"));
  CHECK_THAT(text_of("0-18446744073709551615"), Contains("more than 1,000,000 numbers"));
}
