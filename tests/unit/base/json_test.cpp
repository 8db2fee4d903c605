// SPDX-License-Identifier: GPL-3.0-or-later
#include "orca/base/json.hpp"

#include <catch2/catch.hpp>

#include <limits>

using orca::JsonWriter;

TEST_CASE("objects and arrays are indented, members separated by commas", "[base][json]") {
  JsonWriter json;
  json.begin_object();
  json.member("name", "avoid");
  json.member("depth", 3);
  json.key("ports").begin_array();
  json.value("a");
  json.value(true);
  json.end();
  json.key("none").begin_object();
  json.end();
  json.end();
  CHECK(json.text() ==
        "{\n  \"name\": \"avoid\",\n  \"depth\": 3,\n  \"ports\": [\n    \"a\",\n    true\n  ],\n"
        "  \"none\": {}\n}\n");
}

TEST_CASE("characters that JSON reserves are escaped", "[base][json]") {
  JsonWriter json;
  json.value("a\"b\\c\nd\te\rf\x01");
  CHECK(json.text() == "\"a\\\"b\\\\c\\nd\\te\\rf\\u0001\"\n");
}

TEST_CASE("numbers keep their value, and values that are not finite become null", "[base][json]") {
  const auto text = [](auto value) {
    JsonWriter json;
    json.value(value);
    return json.text();
  };
  CHECK(text(0.1) == "0.1\n");
  CHECK(text(std::numeric_limits<std::uint64_t>::max()) == "18446744073709551615\n");
  CHECK(text(std::int64_t{-7}) == "-7\n");
  CHECK(text(std::numeric_limits<double>::infinity()) == "null\n");
  CHECK(text(std::numeric_limits<double>::quiet_NaN()) == "null\n");
}

TEST_CASE("a list of texts is an array", "[base][json]") {
  JsonWriter json;
  json.begin_object();
  json.member("list", std::vector<std::string>{"a", "b"});
  json.end();
  CHECK(json.text() == "{\n  \"list\": [\n    \"a\",\n    \"b\"\n  ]\n}\n");
}
