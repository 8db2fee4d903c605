// SPDX-License-Identifier: GPL-3.0-or-later
#include <catch2/catch.hpp>

#include "all_objects.hpp"
#include "random_object.hpp"
#include "reading.hpp"

using orca::RandomStream;
using orca::test::random_object;
using orca::test::Reading;
using orca::test::reading;

namespace {

// Returns the text with one place changed: a byte replaced, removed, doubled or put in, or a piece moved.
std::string damaged(std::string text, RandomStream& random) {
  constexpr std::string_view kMarks = "<>/\"'&;= \\.-+eEnx09\n\t\x01\xff";
  const std::size_t at = random() % text.size();
  const char mark = random.chance(0.8) ? kMarks[random() % kMarks.size()] : static_cast<char>(random());
  switch (random() % 5) {
    case 0: text[at] = mark; break;
    case 1: text.erase(at, 1 + random() % 20); break;
    case 2: text.insert(at, 1, mark); break;
    case 3: text.insert(random() % text.size(), text.substr(at, random() % 40)); break;
    default: text.resize(at); break;
  }
  return text;
}

// Checks that there is either an object or errors, and that an object can be written and read.
bool is_sound(const Reading& result) {
  if (result.object.has_value() != result.errors.empty()) return false;
  if (!result.object) return true;
  const std::string text = orca::to_xml(result.object->type(), result.object->get());
  const Reading again = reading(text);
  return again.object && orca::to_xml(again.object->type(), again.object->get()) == text;
}

}  // namespace

TEMPLATE_LIST_TEST_CASE("a damaged text gives a sound object or errors", "[text][xml]",
                        orca::test::AllObjects) {
  RandomStream random(21, "damage", orca::Reflection<TestType>::name);
  for (std::uint64_t seed = 0; seed < 10; ++seed) {
    const std::string whole = orca::test::written(random_object<TestType>(seed));
    for (int i = 0; i < 30; ++i) {
      std::string text = damaged(whole, random);
      if (!text.empty() && random.chance(0.3)) text = damaged(text, random);
      INFO(text);
      REQUIRE(is_sound(reading(text)));
    }
  }
}

TEST_CASE("a text cut short anywhere is refused", "[text][xml]") {
  const std::string whole = orca::test::written(random_object<orca::idl::Door>(3));
  for (std::size_t size = 0; size < whole.size(); ++size) {
    const Reading result = reading(whole.substr(0, size));
    REQUIRE_FALSE(result.object);
    REQUIRE_FALSE(result.errors.empty());
  }
}

TEST_CASE("a text with a hundred thousand unknown elements is refused in good time", "[text][xml]") {
  std::string text = "<Ask>";
  for (int i = 0; i < 100'000; ++i) text += "<a" + std::to_string(i) + "/>";
  const Reading result = reading(text + "</Ask>");
  CHECK_FALSE(result.object);
  CHECK_THAT(result.errors, Catch::EndsWith(" more\n"));
}
