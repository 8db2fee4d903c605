// SPDX-License-Identifier: GPL-3.0-or-later
#include "wish.hpp"

#include <catch2/catch.hpp>

using namespace orca::view;
using Catch::Contains;

namespace {

std::string refusal(const std::string& text, std::uint32_t& id) {
  const auto wish = read_wish(text, id);
  return wish ? "" : wish.error().message;
}
std::string refusal(const std::string& text) {
  std::uint32_t id = 0;
  return refusal(text, id);
}

}  // namespace

TEST_CASE("a page asks as one does on a command line", "[view]") {
  std::uint32_t id = 0;
  const auto wish =
      read_wish(R"({"op":"ask","id":7,"command":"set","words":["goto.max_speed","0.3 m/s"]})", id);
  REQUIRE(wish);
  CHECK(id == 7);
  CHECK(wish->op == Wish::Op::ask);
  CHECK(wish->command == "set");
  CHECK(wish->words == std::vector<std::string>{"goto.max_speed", "0.3 m/s"});
  CHECK_FALSE(wish->streams);
}

TEST_CASE("a page looks at ports at a rate", "[view]") {
  std::uint32_t id = 0;
  const auto wish = read_wish(R"({"op":"look","id":4294967295,"port":"base.OdometryPush","rate":30})", id);
  REQUIRE(wish);
  CHECK(wish->op == Wish::Op::look);
  CHECK(wish->id == 4294967295U);
  CHECK(wish->port == "base.OdometryPush");
  CHECK(wish->rate == 30.0);
}

TEST_CASE("what is wrong with a message is said with its number", "[view]") {
  std::uint32_t id = 0;
  CHECK_THAT(refusal(R"({"op":"dance","id":9})", id), Contains("\"dance\"") && Contains("look"));
  CHECK(id == 9);
  CHECK_THAT(refusal(R"({"op":"ask","id":9,"words":"ps"})", id), Contains("words is a list of texts"));
  CHECK(id == 9);
  CHECK_THAT(refusal("nonsense"), Contains("JSON object"));
  CHECK_THAT(refusal("[1]"), Contains("JSON object"));
  CHECK_THAT(refusal(""), Contains("JSON object"));
  for (const char* const number : {"-1", "1.5", "4294967296", "\"7\"", "null"})
    CHECK_THAT(refusal(std::string(R"({"op":"types","id":)") + number + "}"), Contains("32 bits"));
  for (const char* const rate : {"-1", "1001", "1e300", "1e-12"})
    CHECK_THAT(refusal(std::string(R"({"op":"look","id":1,"rate":)") + rate + "}"), Contains("rate"));
}

TEST_CASE("a message that is nested without end is refused", "[view]") {
  const std::string deep =
      R"({"op":"types","x":)" + std::string(400'000, '[') + std::string(400'000, ']') + "}";
  CHECK_THAT(refusal(deep), Contains("JSON object"));
  CHECK_THAT(refusal(std::string(100'000, '[')), Contains("JSON object"));
}
