// SPDX-License-Identifier: GPL-3.0-or-later
#include "channel/fields.hpp"

#include <catch2/catch.hpp>

#include <cstring>

using namespace orca::supervisor;

TEST_CASE("A text that is longer than its message reads as empty, and so does all that follows",
          "[supervisor][channel]") {
  const std::uint64_t excess = GENERATE(1, 2, 1000, UINT64_MAX - 12);
  Message message;
  std::string text = "hello world!";
  FieldWriter(message).text(text);
  const std::uint64_t length = text.size() + excess;
  std::memcpy(message.body.data(), &length, sizeof length);
  FieldReader reader(message);
  reader.text(text);
  CHECK(text.empty());
  std::uint64_t number = 7;
  reader.number(number);
  CHECK(number == 0);
  CHECK_FALSE(reader.is_complete());
}

TEST_CASE("A list that cannot be in its message takes no memory", "[supervisor][channel]") {
  Message message;
  message.body.resize(80);
  FieldReader reader(message);
  std::vector<std::string> list;
  reader.resize(list, 10);
  CHECK(list.size() == 10);
  CHECK_FALSE(reader.is_complete());
  reader.resize(list, 11);
  CHECK(list.empty());
}
