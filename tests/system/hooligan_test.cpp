// SPDX-License-Identifier: GPL-3.0-or-later
// The offences of a plugin that one process can contain, and what it reports before it ends because of the
// others.
#include <signal.h>

#include <catch2/catch.hpp>

#include "deployer.hpp"

using namespace orca::test;
using Catch::Contains;

namespace {

Words hooligan(const std::string& where, const std::string& deed, const Words& clock) {
  return Words{system_graph("hooligan.xml"), "--set", "where=" + where, "--set", "deed=" + deed} +
         with_test_plugins() + clock;
}

Run act(const std::string& where, const std::string& deed, const Words& clock = virtual_clock()) {
  return run_deployer(hooligan(where, deed, clock));
}

const Words kSteady{"--clock", "steady", "--in-process"};
const Words kHosted{"--clock", "steady"};  // in a host process

// Lets the component act with several clocks at the same time.
std::vector<Run> act_with(const std::vector<Words>& clocks, const std::string& where,
                          const std::string& deed) {
  std::vector<Words> commands;
  for (const Words& clock : clocks) commands.push_back(hooligan(where, deed, clock));
  return run_together(commands);
}

const std::vector<Words> kClocks{virtual_clock(), kSteady, kHosted};

std::size_t alarms(const Run& run) { return run.said(": alarm ").size(); }

void check_names_culprit(const std::string& line) {
  CHECK_THAT(line, Contains("bad: ") && Contains("work()"));
  CHECK_THAT(line, Contains("the plugin is ") && Contains("/test_hooligan.so"));
}

}  // namespace

TEST_CASE("a component that behaves raises no alarm, with any clock", "[system][plugins]") {
  for (const Run& run : act_with(kClocks, "work", "none")) {
    INFO(run.err);
    CHECK(run.exit_code() == 0);
    CHECK(alarms(run) == 0);
  }
}

TEST_CASE(
    "a signal that a component causes ends the process, which first names component, hook, plugin and cause",
    "[system][plugins]") {
  struct Case {
    std::string deed;
    int signal;
    std::string text;
  };
  for (const Words& clock : {virtual_clock(), kSteady}) {
    for (const Case& c : {Case{"segfault", SIGSEGV, "SIGSEGV (it used memory that is not there, at 0x0)"},
                          Case{"overflow", SIGSEGV, "SIGSEGV (its stack has overflowed)"},
                          Case{"divide", SIGFPE, "SIGFPE (it divided an integer by zero"},
                          Case{"abort", SIGABRT, "SIGABRT (it called abort()"}}) {
      const Run run = act("work", c.deed, clock);
      CAPTURE(c.deed, clock);
      INFO(run.err);
      REQUIRE(run.ended);
      const std::string line = run.line_with("ended the process with the signal");
      CHECK_THAT(line, Contains(c.text));
      check_names_culprit(line);
      if (!kSanitized) CHECK(run.ending.signal == c.signal);
      CHECK(run.exit_code() != 0);
    }
  }
}

TEST_CASE("the culprit is named even after it has waited and others have run", "[system][plugins]") {
  const Run run = act("after_wait", "segfault");
  INFO(run.err);
  check_names_culprit(run.line_with("ended the process with the signal"));
}

TEST_CASE("an exception where nothing may be thrown ends the process, with its text and the culprit's name",
          "[system][plugins]") {
  const Run run = act("work", "noexcept");
  INFO(run.err);
  REQUIRE(run.ended);
  const std::string line = run.line_with("the brakes are gone");
  CHECK_THAT(line, Contains("where nothing can catch it"));
  check_names_culprit(line);
  if (!kSanitized) CHECK(run.ending.signal == SIGABRT);
}

TEST_CASE("a component that changes what std::terminate() does cannot turn a crash into success",
          "[system][plugins]") {
  const Run run = run_deployer(Words{system_graph("hooligan.xml"), "--set", "where=start", "--set",
                                     "deed=terminate", "--set", "then=noexcept"} +
                               with_test_plugins() + virtual_clock());
  INFO(run.err);
  REQUIRE(run.ended);
  CHECK_THAT(run.line_with("alarm TERMINATE_HANDLER"), Contains("bad: ") && Contains("start() has "));
  check_names_culprit(run.line_with("the brakes are gone"));
  CHECK(run.exit_code() != 0);
}

TEST_CASE("a component that redirects stdout loses nobody's output", "[system][plugins]") {
  const Run run = act("work", "redirect");
  INFO(run.err);
  CHECK(run.exit_code() == 0);
  CHECK_THAT(run.out, Contains("trace-hash "));
}

TEST_CASE("an exception without a text is reported by its type", "[system][plugins]") {
  for (const Run& run : act_with(kClocks, "work", "mute")) {
    INFO(run.err);
    CHECK(run.exit_code() == 0);
    CHECK_THAT(run.line_with("bad: "), Contains("work() threw (anonymous namespace)::Mute"));
  }
}

TEST_CASE("a component may use 1.2 MB of stack, with every executor", "[system][plugins]") {
  const std::vector<Words> executors{virtual_clock(),
                                     kSteady,
                                     kHosted,
                                     {"--clock", "virtual", "--executor", "baton"},
                                     kSteady + Words{"--executor", "fiber"},
                                     kHosted + Words{"--executor", "fiber"}};
  for (const Run& run : act_with(executors, "work", "stack")) {
    INFO(run.err);
    CHECK(run.exit_code() == 0);
    CHECK(alarms(run) == 0);
  }
}

TEST_CASE("a configure() that hangs ends the start with 3, and component and hook are named",
          "[system][plugins]") {
  for (const Run& run : act_with(kClocks, "configure", "hang")) {
    INFO(run.err);
    REQUIRE(run.ended);
    CHECK(run.exit_code() == 3);
    CHECK_FALSE(run.says("counted"));
    CHECK_THAT(run.line_with("configure()"), Contains("bad"));
  }
}

TEST_CASE("exit() in a component ends the process with status 1 and the culprit's name",
          "[system][plugins]") {
  for (const std::string deed : {"exit", "quick_exit"}) {
    const Run run = act("work", deed);
    CAPTURE(deed);
    INFO(run.err);
    REQUIRE(run.ended);
    CHECK(run.exit_code() == 1);
    check_names_culprit(run.line_with("called " + deed + "("));
  }
}

TEST_CASE(
    "a component that closes the process's descriptors ends it with status 1 and its name on the true stderr",
    "[system][plugins]") {
  const Run run = act("configure", "close");
  INFO(run.err);
  REQUIRE(run.ended);
  CHECK(run.exit_code() == 1);
  CHECK_THAT(run.line_with("has closed descriptors that are not its own"),
             Contains("bad: ") && Contains("configure()"));
}

TEST_CASE("the copy that a component makes by fork() is ended, the component is named, and the run goes on",
          "[system][plugins]") {
  const Run run = act("configure", "fork");
  INFO(run.err);
  REQUIRE(run.ended);
  CHECK(run.exit_code() == 0);
  CHECK(run.says("counter: counted 30 laps"));
  CHECK_THAT(run.line_with("alarm FORK"), Contains("bad: ") && Contains("configure() has called fork()"));
  CHECK(run.said("counted 30 laps").size() == 1);
}

TEST_CASE("what belongs to the whole process is restored, and one alarm names component and hook",
          "[system][plugins]") {
  struct Case {
    std::string deed;
    std::string alarm;
  };
  for (const std::string where : {"start", "work"}) {
    for (const Case& c :
         {Case{"locale", R"x(alarm LOCALE: @ has changed the locale from "C" to "C.UTF-8")x"},
          Case{"rounding", "alarm FLOATING_POINT: @ has changed how numbers are rounded"},
          Case{"folder", "alarm WORKING_FOLDER: @ has changed the working folder to /"},
          Case{"mask", "alarm SIGNAL_MASK: @ has blocked SIGUSR1"},
          Case{"handler", "alarm SIGNAL_HANDLER: @ has changed what happens at SIGTERM"},
          Case{"redirect", "alarm REDIRECTION: @ has redirected stdout to /dev/null"},
          Case{"terminate", "alarm TERMINATE_HANDLER: @ has changed what std::terminate() does"},
          Case{"umask", "alarm UMASK: @ has changed the umask"},
          Case{"limit", "alarm RESOURCE_LIMIT: @ has changed the limit of the number of descriptors"}}) {
      const Run run = act(where, c.deed);
      CAPTURE(c.deed, where);
      INFO(run.err);
      CHECK(run.exit_code() == 0);
      CHECK(alarms(run) == 1);
      std::string expected = "bad: " + c.alarm;
      expected.replace(expected.find('@'), 1, where + "()");
      CHECK_THAT(run.line_with("alarm"), Contains(expected));
    }
  }
}

TEST_CASE(
    "a component that opens a descriptor in each lap and closes none is named long before there are none "
    "left",
    "[system][plugins]") {
  const Run run = run_deployer(
      Words{system_graph("hooligan.xml"), "--set", "where=work", "--set", "deed=leak", "--set", "laps=100"} +
      with_test_plugins() + virtual_clock());
  INFO(run.err);
  CHECK(run.exit_code() == 0);
  CHECK(alarms(run) == 1);
  CHECK_THAT(run.line_with("alarm DESCRIPTORS"),
             Contains("bad: ") && Contains("work() has opened 32 descriptors and not closed them"));
}

TEST_CASE("a component that opens descriptors in start() and leaves them open in stop() is named",
          "[system][plugins]") {
  const Run run = act("start", "leak");
  INFO(run.err);
  CHECK_THAT(run.line_with("alarm DESCRIPTORS"),
             Contains("bad: ") &&
                 Contains("stop() has left open what start() or itself has opened: descriptor ") &&
                 Contains("(/dev/null)"));
}

// A sanitizer needs a descriptor itself to look whether memory may be read.
#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
TEST_CASE("a component that takes all descriptors is named", "[system][plugins]") {
  const Run run = act("start", "leak_all");
  INFO(run.err);
  REQUIRE(run.ended);
  CHECK_THAT(run.line_with("without a free descriptor"), Contains("bad: ") && Contains("start()"));
}
#endif

TEST_CASE("memory that a component takes is blamed on nobody", "[system][plugins]") {
  for (const Run& run : act_with(kClocks, "work", "memory")) {
    INFO(run.err);
    CHECK(run.exit_code() == 0);
    CHECK(alarms(run) == 0);
  }
}

TEST_CASE(
    "a hard limit that a component lowers, and that nobody can raise again, is blamed on it alone, once",
    "[system][plugins]") {
  for (const std::string where : {"configure", "start", "work"}) {
    const Run run = act(where, "hard_limit");
    CAPTURE(where);
    INFO(run.err);
    CHECK(run.exit_code() == 0);
    CHECK(alarms(run) == 1);
    CHECK_THAT(run.line_with("alarm RESOURCE_LIMIT"),
               Contains("bad: alarm RESOURCE_LIMIT: " + where + "() has changed the limit of the CPU time"));
  }
}

TEST_CASE("a thread that a component leaves behind keeps its plugin in memory, and an alarm says so",
          "[system][plugins]") {
  const Run run = act("start", "thread");
  INFO(run.err);
  CHECK(run.exit_code() == 0);
  CHECK_THAT(run.line_with("alarm PLUGIN_PINNED"), Contains("test_hooligan.so"));
}

TEST_CASE(
    "a component that sleeps by itself is named: in virtual time, where it holds up all others, the run ends",
    "[system][plugins]") {
  const Run run = act("work", "sleep");
  INFO(run.err);
  REQUIRE(run.ended);
  CHECK(run.exit_code() == 1);
  CHECK_THAT(run.line_with("bad: "), Contains("has slept in the system for more than 2 s"));
  CHECK(run.ending.wall < Seconds(8) * kSlowdown);
}

TEST_CASE("a component that sleeps in its own thread is named, and costs the others nothing",
          "[system][plugins]") {
  for (const Run& run : act_with({kSteady, kHosted}, "work", "sleep")) {
    INFO(run.err);
    REQUIRE(run.ended);
    CHECK(run.says("counter: counted 30 laps"));
    CHECK_THAT(run.line_with("alarm STALLED"), Contains("bad: "));
  }
}
