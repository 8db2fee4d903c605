// SPDX-License-Identifier: GPL-3.0-or-later
#include "access.hpp"

#include <catch2/catch.hpp>
#include <set>

using namespace orca::view;

TEST_CASE("whoever knows a token has its role, and nobody else has one", "[view]") {
  const auto tokens = Tokens::draw();
  REQUIRE(tokens);
  for (const Role role : {Role::observe, Role::operate, Role::change}) {
    const std::string token = tokens->of(role);
    CHECK(token.size() == 32);
    CHECK(tokens->role_of(token) == role);
    CHECK_FALSE(tokens->role_of(token.substr(0, 31)));
    CHECK_FALSE(tokens->role_of(token + "0"));
  }
  CHECK_FALSE(tokens->role_of(""));
  CHECK_FALSE(tokens->role_of(std::string(32, '0')));
}

TEST_CASE("each run has other tokens", "[view]") {
  std::set<std::string> seen;
  for (int i = 0; i < 20; ++i) {
    const auto tokens = Tokens::draw();
    REQUIRE(tokens);
    for (const Role role : Tokens::kRoles) seen.insert(tokens->of(role));
  }
  CHECK(seen.size() == 60);
}

TEST_CASE("a request must name this machine as its host", "[view]") {
  for (const char* const host :
       {"127.0.0.1:8080", "localhost:8080", "[::1]:8080", "localhost:9000", "127.0.0.1"})
    CHECK(is_own_host(host));
  // A page of somebody else that lets its own name point here is another host.
  for (const char* const host : {"", "evil.org:8080", "127.0.0.1:8080.evil.org", "127.0.0.1.evil.org",
                                 "localhost:", "localhost:80a", " localhost:8080", "localhost@evil.org"})
    CHECK_FALSE(is_own_host(host));
}

TEST_CASE("a request may come from a page of this server, or from no page", "[view]") {
  CHECK(is_own_origin("", "localhost:8080"));
  CHECK(is_own_origin("http://127.0.0.1:8080", "127.0.0.1:8080"));
  CHECK(is_own_origin("http://localhost:9000", "localhost:9000"));
  for (const char* const origin :
       {"null", "http://evil.org", "https://127.0.0.1:8080", "http://127.0.0.1:9090", "http://localhost:8080",
        "http://127.0.0.1:8080.evil.org", "file://"})
    CHECK_FALSE(is_own_origin(origin, "127.0.0.1:8080"));
}

TEST_CASE("each door knows its own names and its own origins only", "[view]") {
  const Calling far{"https", {"robot", "*.lab.org", "10.0.0.7", "[fd00::7]"}};
  for (const char* const host :
       {"robot", "robot:8443", "Robot:8443", "scout.lab.org", "10.0.0.7:8443", "[fd00::7]:8443", "[fd00::7]"})
    CHECK(is_own_host(host, far));
  for (const char* const host : {"127.0.0.1:8443", "localhost:8443", "[::1]:8443", "lab.org", ".lab.org",
                                 "a.b.lab.org", "xlab.org", "*.lab.org.evil.org", "robot.evil.org",
                                 "robot:", "robot:8443:1", "fd00::7", "[fd00::7", "[fd00::7]x:1", ""})
    CHECK_FALSE(is_own_host(host, far));
  CHECK(is_own_origin("https://robot:8443", "robot:8443", far));
  CHECK_FALSE(is_own_origin("http://robot:8443", "robot:8443", far));
  for (const char* const host : {"robot:8080", "10.0.0.7:8080", "[fd00::7]:8080"})
    CHECK_FALSE(is_own_host(host));
}

TEST_CASE("a value of a request's query is found by its name", "[view]") {
  CHECK(query_value("/ws?token=1f", "token") == "1f");
  CHECK(query_value("/ws?a=b&token=1f&c=d", "token") == "1f");
  CHECK(query_value("/ws?mytoken=1f", "token").empty());
  CHECK(query_value("/ws?token", "token").empty());
  CHECK(query_value("/ws", "token").empty());
  CHECK(query_value("token=1f", "token").empty());
}

TEST_CASE("only an Ask or an AskReading, with nothing before it, asks without an order", "[view]") {
  for (const char* const xml :
       {"<Ask/>", "<AskReading/>", "<Ask about=\"map\"/>", "<AskReading\n/>", "<Ask></Ask>"})
    CHECK(only_asks(xml));
  for (const char* const xml :
       {"", "<Ask", "Ask", "<Asking/>", "<AskReadings/>", "<TripOrder/>", " <Ask/>",
        "<!-- <Ask/> --><TripOrder/>", "<?xml version=\"1.0\"?><Ask/>", "<Ask-/>", "<ask/>"})
    CHECK_FALSE(only_asks(xml));
}
