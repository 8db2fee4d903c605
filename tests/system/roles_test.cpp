// SPDX-License-Identifier: GPL-3.0-or-later
// What other users may do with a running system whose owner has given them roles. Needs root, to be several users.
#include <grp.h>
#include <unistd.h>

#include <catch2/catch.hpp>
#include <string>

#include "deployer.hpp"
#include "hosted_system.hpp"
#include "orca/supervisor/channel.hpp"
#include "orca/supervisor/control.hpp"
#include "orca/supervisor/control_socket.hpp"

using namespace orca::test;
using Catch::Contains;

namespace {

const std::string kObserver = "60001";
const std::string kOperator = "60002";
const std::string kOperators = "60100";  // a group
const std::string kStranger = "60003";

// Runs orcactl as another user, in a group of the same number and in another one.
Run ask_as(const std::string& user, const Words& words, const std::string& group = "60099") {
  Subprocess program(Words{"/usr/bin/setpriv", "--reuid", user, "--regid", user, "--groups", group} +
                     orcactl(Words{"--of", "root"} + words));
  return finish(program, Seconds(20));
}

bool can_be_others() {
  if (geteuid() == 0) return true;
  WARN("only root can be several users");
  return false;
}

Words shared_scout() {
  return {source_file("graphs/scout_goto_processes.xml"),
          "--hold",
          "--allow",
          "observe=user:" + kObserver,
          "--allow",
          "operate=group:" + kOperators};
}

}  // namespace

TEST_CASE("other users may do what their role says, and nothing else", "[system][roles]") {
  if (!can_be_others()) return;
  Subprocess deployer_(deployer(shared_scout()));
  REQUIRE(comes_true([] { return ask_as(kObserver, {"ps"}).exit_code() == 0; }, Seconds(20)));
  const Words look{"ps"}, steer{"estop"}, change{"set", "goto.max_speed", "0.1 m/s"};

  for (const Words& order : {look, steer, change, Words{"stop"}}) {
    const Run run = ask_as(kStranger, order);
    CHECK(run.exit_code() == 1);
    CHECK_THAT(run.err,
               Contains("user 60003 has none") && Contains("user 0, can give it: deployer --allow "));
  }
  CHECK(ask_as(kObserver, {"log", "audit"}).exit_code() == 0);
  const Run estop = ask_as(kObserver, steer);
  CHECK(estop.exit_code() == 1);
  CHECK_THAT(estop.err,
             Contains(R"("estop" takes the role operate in this system, and user 60001 has only observe)"));
  CHECK(ask_as(kObserver, {"send", "base.MotionCommandSend", "<MotionCommand/>"}).exit_code() == 1);

  CHECK(ask_as(kOperator, steer, kOperators).exit_code() == 0);
  CHECK(ask_as(kOperator, {"estop", "--release"}, kOperators).exit_code() == 0);
  CHECK(ask_as(kOperator, steer).exit_code() == 1);  // not in the group
  const Run swap = ask_as(kOperator, {"swap", "goto", "/tmp/evil.so"}, kOperators);
  CHECK(swap.exit_code() == 1);
  CHECK_THAT(swap.err, Contains("takes the role change"));
  CHECK(ask_as(kOperator, {"stop"}, kOperators).exit_code() == 1);

  const std::string log = run_orcactl({"log", "audit"}).out;
  CHECK_THAT(log, Contains("user 60002, orcactl[") && Contains("Z: estop: done") &&
                      Contains("Z: stop: not done: \"stop\" takes the role change"));
  CHECK(run_orcactl({"stop"}).exit_code() == 0);
  CHECK(finish(deployer_, Seconds(20)).exit_code() == 0);
  CHECK(ask_as(kObserver, look).exit_code() == 3);
}

TEST_CASE("without --allow no other user finds a system", "[system][roles]") {
  if (!can_be_others()) return;
  Subprocess deployer_(deployer({source_file("graphs/scout_goto_processes.xml"), "--hold"}));
  REQUIRE(comes_true([] { return run_orcactl({"ps"}).exit_code() == 0; }, Seconds(20)));
  CHECK(ask_as(kObserver, {"ps"}).exit_code() == 3);
  CHECK(run_orcactl({"stop"}).exit_code() == 0);
  CHECK(finish(deployer_, Seconds(20)).exit_code() == 0);
}

TEST_CASE("a line for looking takes no objects, so who may look cannot send", "[system][roles]") {
  using namespace orca::supervisor;
  using namespace std::chrono_literals;
  Subprocess deployer_(deployer({source_file("graphs/scout_goto_processes.xml"), "--hold"}));
  REQUIRE(comes_true(
      [] {
        return run_orcactl({"hz", "base.OdometryPush", "--for", "50 ms"}).exit_code() == 0;
      },
      Seconds(20)));
  for (const bool taps : {false, true}) {
    CAPTURE(taps);
    Channel client(std::move(connect_to_system("scout_goto_processes")).value());
    Ask ask{"line", {"base.MotionCommandSend"}, false};
    if (taps) ask.words.emplace_back("--tap");
    REQUIRE(client.send(encode(ask, 1), 5s).ok());
    auto answer = decode_answer(std::move(client.wait_for_message(5s)).value());
    REQUIRE(answer);
    REQUIRE(std::holds_alternative<LineAnswer>(*answer));
    Channel line(std::move(std::get<LineAnswer>(*answer).line));
    REQUIRE(line.send(encode(LineWord(Offer{"no.Type", {}}), 1), 5s).ok());
    auto heard = line.wait_for_message(5s);
    while (taps && heard && heard->kind == Kind::tapped) heard = line.wait_for_message(5s);  // on its way
    CHECK(bool(heard) == !taps);  // an outcome, or the end of the line
    if (!heard) CHECK(heard.error().code == orca::Code::unavailable);
  }
  CHECK(run_orcactl({"stop"}).exit_code() == 0);
  CHECK(finish(deployer_, Seconds(20)).exit_code() == 0);
}

TEST_CASE("a role that is written wrong is refused before anything starts", "[system][roles]") {
  for (const char* const grant :
       {"all=user:root", "observe", "observe=root", "observe=user:", "observe=user:no_such_user",
        "change=group:no_such_group", "none=user:root"}) {
    CAPTURE(grant);
    const Run run = run_deployer({source_file("graphs/scout_goto_processes.xml"), "--allow", grant});
    CHECK(run.exit_code() == 2);
    CHECK(run.says("--allow: "));
  }
  const Run run = run_deployer(Words{source_file("graphs/scout_goto.xml"), "--allow", "observe=user:root"} +
                               virtual_clock());
  CHECK(run.exit_code() == 2);
  CHECK(run.says("--allow: orcactl reaches host processes only"));
}
