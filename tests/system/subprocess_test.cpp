// SPDX-License-Identifier: GPL-3.0-or-later
// The helper that all system tests use.
#include "subprocess.hpp"

#include <signal.h>

#include <catch2/catch.hpp>

#include "temp_folder.hpp"

using orca::test::Seconds;
using orca::test::Subprocess;
using orca::test::TempFolder;

namespace {

std::vector<std::string> shell(const std::string& script) { return {"/bin/sh", "-c", script}; }

pid_t first_number(const std::string& text) { return std::stoi(text); }

bool lives(pid_t pid) { return kill(pid, 0) == 0; }

}  // namespace

TEST_CASE("a subprocess gets its input, and its stdout and stderr are captured separately", "[support]") {
  Subprocess program(shell("read a; echo out $a; echo err $a >&2; exit 7"), {.input = "hello\n"});
  const auto ending = program.wait(Seconds(10));
  REQUIRE(ending);
  CHECK(ending->exit_code == 7);
  CHECK(ending->signal == 0);
  CHECK(program.out() == "out hello\n");
  CHECK(program.err() == "err hello\n");
}

TEST_CASE("a subprocess that writes a megabyte does not wait for its reader", "[support]") {
  Subprocess program(shell("head -c 1000000 /dev/zero"));
  REQUIRE(program.wait(Seconds(10)));
  CHECK(program.out().size() == 1000000);
}

TEST_CASE("input can follow later, and output can be waited for", "[support]") {
  Subprocess program(shell("echo ready; read a; echo got $a; read b || echo end"), {.keep_input_open = true});
  REQUIRE(program.wait_for_output("ready", Seconds(10)));
  CHECK_FALSE(program.wait_for_output("got", Seconds(0.1)));
  program.write_input("it\n");
  REQUIRE(program.wait_for_output("got it", Seconds(10)));
  program.close_input();
  CHECK(program.wait_for_output("end", Seconds(10)));
}

TEST_CASE("a signal reaches the subprocess, and its ending says which one it was", "[support]") {
  Subprocess program(shell("sleep 60"));
  CHECK_FALSE(program.wait(Seconds(0.05)));
  program.send_to_group(SIGTERM);
  const auto ending = program.wait(Seconds(10));
  REQUIRE(ending);
  CHECK(ending->signal == SIGTERM);
  CHECK(ending->exit_code == -1);
}

TEST_CASE("the CPU time of a subprocess is measured, and is not wall time: a sleeping one uses none",
          "[support]") {
  Subprocess busy(shell("i=0; while [ $i -lt 300000 ]; do i=$((i+1)); done"));
  Subprocess idle(shell("sleep 0.3"));
  const auto worked = busy.wait(Seconds(60));
  const auto slept = idle.wait(Seconds(60));
  REQUIRE(worked);
  REQUIRE(slept);
  CHECK(worked->cpu > Seconds(0.01));
  CHECK(slept->cpu < Seconds(0.2));
  CHECK(slept->wall >= Seconds(0.3));
}

TEST_CASE("a subprocess takes its whole group along when it is destroyed", "[support]") {
  pid_t child = 0;
  {
    Subprocess program(shell("sleep 60 & echo $!; wait"));
    REQUIRE(program.wait_for_output("\n", Seconds(10)));
    child = first_number(program.out());
    REQUIRE(lives(child));
  }
  for (int i = 0; i < 200 && lives(child); ++i) usleep(10000);
  CHECK_FALSE(lives(child));
}

TEST_CASE("processes that a program leaves behind in its group are noticed", "[support]") {
  Subprocess tidy(shell("exit 0"));
  REQUIRE(tidy.wait(Seconds(10)));
  CHECK_FALSE(tidy.group_lives());
  Subprocess untidy(shell("sleep 60 & exit 0"));
  REQUIRE(untidy.wait(Seconds(10)));
  CHECK(untidy.group_lives());
}

TEST_CASE("a program that cannot be started says so and ends with 127", "[support]") {
  Subprocess program({"/no/such/program"});
  const auto ending = program.wait(Seconds(10));
  REQUIRE(ending);
  CHECK(ending->exit_code == 127);
  CHECK(program.err().find("/no/such/program") != std::string::npos);
}

TEST_CASE("a temporary folder takes files, also in folders of its own, and is gone afterwards", "[support]") {
  std::filesystem::path path;
  {
    const TempFolder folder;
    path = folder.path();
    CHECK(orca::test::read_text(folder.write("a/b.txt", "text")) == "text");
  }
  CHECK_FALSE(std::filesystem::exists(path));
}
