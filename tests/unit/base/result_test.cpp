// SPDX-License-Identifier: GPL-3.0-or-later
#include <catch2/catch.hpp>

#include <string>
#include <utility>
#include <vector>

#include "orca/base/result.hpp"

using orca::Code;
using orca::Result;

TEST_CASE("a Result holds a value or an error that says where and what", "[base][result]") {
  const Result<int> good = 3;
  CHECK(good.has_value());
  CHECK(*good == 3);
  const Result<int> bad = orca::fail(Code::not_found, "no port 'scna'", "graph.xml:3:1");
  CHECK_FALSE(bad.has_value());
  CHECK(bad.error().text() == "graph.xml:3:1: no port 'scna'");
  CHECK(bad.value_or(7) == 7);
  CHECK_THROWS_AS(bad.value(), std::logic_error);
}

TEST_CASE("and_then runs on a value and passes an error through", "[base][result]") {
  const auto half = [](int n) -> Result<int> {
    if (n % 2 != 0) return orca::fail(Code::invalid_argument, "odd");
    return n / 2;
  };
  CHECK(*Result<int>(8).and_then(half).and_then(half) == 2);
  CHECK(Result<int>(6).and_then(half).and_then(half).error().message == "odd");
}

TEST_CASE("a Status is ok until it holds an error", "[base][result]") {
  CHECK(orca::ok().ok());
  const orca::Status bad = orca::fail(Code::unavailable, "gone");
  CHECK_FALSE(bad);
  CHECK(bad.error().code == Code::unavailable);
}

TEST_CASE("every error code has its name", "[base][result]") {
  const std::vector<std::pair<Code, std::string>> names{{Code::invalid_argument, "invalid_argument"},
                                                        {Code::not_found, "not_found"},
                                                        {Code::already_exists, "already_exists"},
                                                        {Code::failed_precondition, "failed_precondition"},
                                                        {Code::unavailable, "unavailable"},
                                                        {Code::deadline_exceeded, "deadline_exceeded"},
                                                        {Code::data_loss, "data_loss"},
                                                        {Code::unimplemented, "unimplemented"},
                                                        {Code::internal, "internal"}};
  for (const auto& [code, name] : names) CHECK(to_string(code) == name);
}
