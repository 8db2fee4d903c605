// SPDX-License-Identifier: GPL-3.0-or-later
#include "access.hpp"

#include <catch2/catch.hpp>
#include <set>

using namespace orca::view;

TEST_CASE("whoever knows a token has its role, and nobody else has one", "[view]") {
  const auto tokens = Tokens::draw();
  REQUIRE(tokens);
  const std::string steering = tokens->of(Role::operator_);
  CHECK(steering.size() == 32);
  CHECK(tokens->role_of(steering) == Role::operator_);
  CHECK(tokens->role_of(tokens->of(Role::reader)) == Role::reader);
  CHECK_FALSE(tokens->role_of(""));
  CHECK_FALSE(tokens->role_of(steering.substr(0, 31)));
  CHECK_FALSE(tokens->role_of(steering + "0"));
  CHECK_FALSE(tokens->role_of(std::string(32, '0')));
}

TEST_CASE("each run has other tokens", "[view]") {
  std::set<std::string> seen;
  for (int i = 0; i < 20; ++i) {
    const auto tokens = Tokens::draw();
    REQUIRE(tokens);
    seen.insert(tokens->of(Role::reader));
    seen.insert(tokens->of(Role::operator_));
  }
  CHECK(seen.size() == 40);
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

TEST_CASE("a reader may ask what is so, and change nothing", "[view]") {
  for (const char* const command :
       {"ps", "graph", "machines", "team", "ports", "plugins", "counters", "log", "get", "missions", "names"})
    CHECK(only_shows(command, true));
  CHECK(only_shows("alarms", false));
  CHECK_FALSE(only_shows("alarms", true));  // alarms ack all
  CHECK(only_shows("pace", false));
  CHECK_FALSE(only_shows("pace", true));  // pace 0
  for (const char* const command : {"estop", "stop", "restart", "suspend", "resume", "swap", "apply",
                                    "connect", "disconnect", "move", "set", "line", "diff", "whatever"})
    CHECK_FALSE(only_shows(command, true));
}
