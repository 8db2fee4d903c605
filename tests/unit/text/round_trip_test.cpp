// SPDX-License-Identifier: GPL-3.0-or-later
#include <catch2/catch.hpp>

#include "all_objects.hpp"
#include "nasty_object.hpp"
#include "random_object.hpp"
#include "reading.hpp"
#include "serialized.hpp"

using orca::test::nasty_object;
using orca::test::random_object;
using orca::test::read;
using orca::test::serialized;
using orca::test::written;

TEMPLATE_LIST_TEST_CASE("any object comes back equal from its text", "[text][xml]", orca::test::AllObjects) {
  for (std::uint64_t seed = 0; seed < 100; ++seed) {
    const auto original = random_object<TestType>(seed);
    INFO("seed " << seed);
    REQUIRE(read<TestType>(written(original)) == original);
  }
}

TEMPLATE_LIST_TEST_CASE("any object comes back bit for bit, with whatever numbers and texts it holds",
                        "[text][xml]", orca::test::AllObjects) {
  for (std::uint64_t seed = 0; seed < 300; ++seed) {
    const auto original = nasty_object<TestType>(seed);
    const std::string text = written(original);
    INFO("seed " << seed << "\n" << text);
    const auto copy = read<TestType>(text);
    REQUIRE(serialized(copy) == serialized(original));  // NaN differs from itself, its bits do not.
    REQUIRE(written(copy) == text);                     // XCDR1 ends a text at its first zero, XML does not.
  }
}

TEMPLATE_LIST_TEST_CASE("a default object comes back from a text that has only its plain values",
                        "[text][xml]", orca::test::AllObjects) {
  CHECK(read<TestType>(written(TestType())) == TestType());
  CHECK_THAT(written(TestType()), Catch::EndsWith("/>"));
  CHECK(read<TestType>("<" + std::string(orca::object_type<TestType>().name) + "/>") == TestType());
}
