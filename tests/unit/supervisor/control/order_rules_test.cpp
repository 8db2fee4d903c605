// SPDX-License-Identifier: GPL-3.0-or-later
#include "control/order_rules.hpp"

#include <unistd.h>

#include <catch2/catch.hpp>
#include <string>
#include <vector>

#include "control/control_server.hpp"
#include "orca/base/log.hpp"
#include "runtime_folder.hpp"

using namespace orca;
using namespace orca::supervisor;

namespace {

Ask ask(const std::string& command, std::vector<std::string> words = {}) {
  return {command, std::move(words), false};
}

ucred self() { return {getpid(), geteuid(), getegid()}; }

bool has(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

// What Audit writes while it lives.
struct Written {
  std::vector<std::string> lines;
  std::vector<log::Level> levels;
  log::Listener listener{[this](const log::Line& line) {
    if (line.who != Audit::kAuditName) return;
    lines.emplace_back(line.text);
    levels.push_back(line.level);
  }};
};

}  // namespace

TEST_CASE("what only looks is no order, and may be asked by whoever may look", "[supervisor][audit]") {
  for (const char* const command :
       {"ps", "graph", "file", "machines", "team", "ports", "plugins", "names", "objects", "roles",
        "counters", "alarms", "missions", "log", "get", "pace", "sources"}) {
    CAPTURE(command);
    CHECK_FALSE(is_order(ask(command)));
    CHECK(access_for(ask(command)) == Access::observe);
  }
  CHECK_FALSE(is_order(ask("line", {"base.OdometryPush", "--tap"})));
  CHECK(access_for(ask("line", {"base.OdometryPush", "--tap"})) == Access::observe);
}

TEST_CASE("steering needs less than changing what runs", "[supervisor][audit]") {
  for (const char* const command : {"estop", "suspend", "resume", "pause", "step", "line"}) {
    CAPTURE(command);
    CHECK(is_order(ask(command, {"base.MotionCommandSend"})));
    CHECK(access_for(ask(command, {"base.MotionCommandSend"})) == Access::operate);
  }
  for (const char* const command : {"alarms", "pace"}) {
    CAPTURE(command);
    CHECK(is_order(ask(command, {"1"})));
    CHECK(access_for(ask(command, {"1"})) == Access::operate);
  }
  CHECK_FALSE(is_order(ask("file", {"--keep"})));
  CHECK(access_for(ask("file", {"--keep"})) == Access::operate);
  for (const char* const command :
       {"swap", "apply", "connect", "disconnect", "move", "set", "restart", "stop", "of a later version"}) {
    CAPTURE(command);
    CHECK(is_order(ask(command)));
    CHECK(access_for(ask(command)) == Access::change);
  }
  // They change nothing, but read a file or run code.
  for (const char* const command : {"fits", "diff"}) {
    CAPTURE(command);
    CHECK_FALSE(is_order(ask(command)));
    CHECK(access_for(ask(command)) == Access::change);
  }
}

TEST_CASE("the log says who has ordered what, and what came of it", "[supervisor][audit]") {
  const Written written;
  const Audit audit;
  const std::string order = audit.describe(ask("set", {"avoid.speed", "0.2 m/s"}), self());
  CAPTURE(order);
  CHECK(has(order, "(" + std::to_string(geteuid()) + ")"));
  CHECK(has(order, "[" + std::to_string(getpid()) + "], at 20"));
  CHECK(has(order, "Z: set"));
  CHECK(has(order, "'0.2 m/s'"));
  Audit::note(order, ok());
  Audit::note(order, fail(Code::invalid_argument, "too fast"));
  REQUIRE(written.lines.size() == 2);
  CHECK(written.lines[0] == order + ": done");
  CHECK(written.lines[1] == order + ": not done: too fast");
  CHECK(written.levels == std::vector{log::Level::info, log::Level::warning});
}

TEST_CASE("what comes by a page has the role of its address, less than that of its user",
          "[supervisor][audit]") {
  const Written written;
  Audit audit;
  const Asker owner{self(), {}};
  Ask set = ask("set", {"avoid.speed", "0.2"});
  set.via = "page";
  set.most = Access::change;
  CHECK(audit.allow(set, owner, Access::change).ok());
  CHECK(has(audit.describe(set, owner.who), "], by page as change, at 20"));
  set.most = Access::operate;
  const Status refused = audit.allow(set, owner, Access::change);
  REQUIRE_FALSE(refused.ok());
  CHECK(has(refused.error().message, R"("set" takes the role change, and this address has operate)"));
  REQUIRE(written.lines.size() == 1);
  CHECK(has(written.lines[0], ", by page as operate, at 20"));
  CHECK(has(written.lines[0], "not done"));
  // A role that a program claims for somebody gives nobody more than the program has.
  set.most = Access::change;
  CHECK(has(audit.allow(set, {{1, 60'001, 60'001}, {}}, Access::observe).error().message,
            "user 60001 has only observe"));
}

TEST_CASE("who asks learns which role each order takes", "[supervisor][audit]") {
  auto pair = make_socket_pair();
  REQUIRE(pair);
  const auto channel = std::make_shared<Channel>(std::move(pair->supervisor));
  Channel client(std::move(pair->host));
  {
    Reply reply(channel, 1, false);
    show_roles({"ps", "alarms", "alarms ack 3", "line base.OdometryPush --tap", "set", ""}, reply);
  }
  std::vector<std::string> roles;
  for (auto answer = decode_answer(std::move(client.wait_for_message(1s)).value());
       answer && std::holds_alternative<RecordAnswer>(*answer);
       answer = decode_answer(std::move(client.wait_for_message(1s)).value()))
    roles.push_back(std::get<RecordAnswer>(*answer).record.at(1).value);
  CHECK(roles == std::vector<std::string>{"observe", "observe", "operate", "observe", "change", "change"});
}

TEST_CASE("a user without a known name is a number, and a long order is shortened", "[supervisor][audit]") {
  const std::string order =
      Audit().describe(ask("set", {"a.b", std::string(100'000, 'x')}), {999'999'999, 4'000'000, 4'000'000});
  CHECK(order.starts_with("user 4000000, process[999999999], at "));
  CHECK(order.size() < 700);
}

TEST_CASE("who asks at a socket is known from the system, not from what he says", "[supervisor][audit]") {
  const test::RuntimeFolder folder;
  ucred asker{};
  ControlServer server(std::move(ControlSocket::open("system")).value(),
                       [&](const Ask&, const Asker& who, const ReplyPtr&) { asker = who.who; });
  Channel client(std::move(connect_to_system("system")).value());
  REQUIRE(client.post(encode(ask("ps"), 1)).ok());
  server.serve(Moment{100s});
  CHECK(asker.pid == getpid());
  CHECK(asker.uid == geteuid());
  CHECK(asker.gid == getegid());
}

TEST_CASE("the outcome of an order is heard once, also if its client has gone", "[supervisor][audit]") {
  std::vector<Status> heard;
  const auto hears = [&](const Status& outcome) { heard.push_back(outcome); };
  {
    Reply reply({}, 1, false);
    reply.at_end(hears);
    reply.refuse(fail(Code::not_found, "no"));
    CHECK(heard.empty());
  }
  REQUIRE(heard.size() == 1);
  CHECK(heard[0].error().code == Code::not_found);
  {
    Reply reply({}, 2, false);
    reply.at_end(hears);
  }
  REQUIRE(heard.size() == 2);
  CHECK(heard[1].ok());
}

TEST_CASE("who has no role for an order learns which, and cannot fill the log", "[supervisor][audit]") {
  const Written written;
  Audit audit;
  const Asker stranger{{1, 60'001, 60'001}, {}};
  CHECK(audit.allow(ask("ps"), stranger, Access::observe).ok());
  CHECK(audit.allow(ask("swap"), stranger, Access::change).ok());
  CHECK(written.lines.empty());
  const Status refused = audit.allow(ask("swap"), stranger, Access::operate);
  REQUIRE_FALSE(refused.ok());
  CHECK(has(refused.error().message,
            R"("swap" takes the role change in this system, and user 60001 has only operate)"));
  CHECK(has(refused.error().message, "deployer --allow change=user:60001"));
  for (int i = 0; i < 50; ++i) CHECK_FALSE(audit.allow(ask("ps"), stranger, Access::none).ok());
  CHECK(written.lines.size() >= Audit::kMostNoted);
  CHECK(written.lines.size() <= 2 * Audit::kMostNoted);  // a second may have begun meanwhile
  CHECK_FALSE(audit.allow(ask("ps"), {{1, 60'002, 60'002}, {}}, Access::none).ok());
  CHECK(has(written.lines.back(), "user 60002"));
}

TEST_CASE("a role is given to a user or a group, and the most of several counts", "[supervisor][audit]") {
  const auto grants = [](const std::vector<std::string>& texts) {
    std::vector<Grant> all;
    for (const std::string& text : texts) all.push_back(std::move(read_grant(text)).value());
    return all;
  };
  const auto given =
      grants({"observe=user:60001", "operate=group:60100", "change=user:60003", "observe=group:60003"});
  CHECK(access_of({{1, 60'001, 60'001}, {}}, given) == Access::observe);
  CHECK(access_of({{1, 60'001, 60'001}, {60'099, 60'100}}, given) == Access::operate);
  CHECK(access_of({{1, 60'002, 60'100}, {}}, given) == Access::operate);
  CHECK(access_of({{1, 60'003, 60'003}, {}}, given) == Access::change);
  CHECK(access_of({{1, 60'004, 60'004}, {60'099}}, given) == Access::none);
  CHECK(access_of({{1, 60'100, 60'001}, {}}, given) == Access::none);  // a user with the number of a group
  CHECK(access_of(Asker{}, given) == Access::none);
  CHECK(access_of({{1, 0, 0}, {}}, {}) == Access::change);
  CHECK(access_of({self(), {}}, {}) == Access::change);
  for (const char* const wrong :
       {"", "observe", "observe=60001", "see=user:60001", "none=user:60001",
        "observe=user:", "observe=host:a", "observe:user=60001", "observe=user:no such user",
        "observe=user:-1", "observe=user:99999999999999"}) {
    CAPTURE(wrong);
    CHECK(read_grant(wrong).error().code == Code::invalid_argument);
  }
}
