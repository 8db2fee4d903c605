// SPDX-License-Identifier: GPL-3.0-or-later
// Programs that a program starts beside itself.
#include "common/child_program.hpp"

#include <signal.h>
#include <unistd.h>

#include <catch2/catch.hpp>
#include <chrono>

#include "temp_folder.hpp"

using namespace orca;
using apps::ChildProgram;

namespace {

ChildProgram shell(const std::string& text, ChildProgram::Reads reads = ChildProgram::Reads::everything) {
  Result<ChildProgram> program = ChildProgram::start({"/bin/sh", "-c", text}, reads);
  REQUIRE(program);
  return std::move(program).value();
}

}  // namespace

TEST_CASE("what a program prints first is read, and how it ends is known", "[apps][program]") {
  ChildProgram program = shell("echo one; exit 3");
  CHECK(program.first_line() == "one");
  CHECK(program.wait() == 3);
  CHECK(program.ended() == 3);
  CHECK(program.end() == 3);  // again
  CHECK(apps::ending_text(3) == "exit status 3");
}

TEST_CASE("which streams are read is the caller's choice", "[apps][program]") {
  CHECK(shell("echo complaint >&2; echo result", ChildProgram::Reads::standard_output).first_line() ==
        "result");
  CHECK(shell("echo complaint >&2; echo result", ChildProgram::Reads::everything).first_line() ==
        "complaint");
  CHECK_FALSE(shell("exit 0", ChildProgram::Reads::nothing).output());
}

TEST_CASE("a program is asked to end, and one that does not listen is killed", "[apps][program]") {
  ChildProgram obedient = shell("echo up; exec sleep 100");
  CHECK(obedient.first_line() == "up");
  CHECK_FALSE(obedient.ended());
  CHECK(obedient.end() == 128 + SIGTERM);
  CHECK(apps::ending_text(128 + SIGTERM) == "signal 15");
  ChildProgram deaf = shell("trap '' TERM; echo up; exec sleep 100");
  CHECK(deaf.first_line() == "up");
  CHECK(deaf.end() == 128 + SIGKILL);
}

TEST_CASE("a program runs in the folder that it is given, and reads nothing", "[apps][program]") {
  const test::TempFolder folder;
  Result<ChildProgram> program = ChildProgram::start({"/bin/sh", "-c", "pwd; cat; exit 0"},
                                                     ChildProgram::Reads::everything, folder.path().string());
  REQUIRE(program);
  CHECK(program->first_line() == folder.path().string());
  CHECK(program->wait() == 0);
}

TEST_CASE("a program whose end the system throws away counts as ended", "[apps][program]") {
  const auto before = signal(SIGCHLD, SIG_IGN);
  ChildProgram program = shell("exit 0", ChildProgram::Reads::nothing);
  CHECK(program.wait() == 127);
  signal(SIGCHLD, before);
}

TEST_CASE("a program that is not there ends at once with what a shell says of it", "[apps][program]") {
  Result<ChildProgram> program =
      ChildProgram::start({"orca-has-no-such-program"}, ChildProgram::Reads::nothing);
  REQUIRE(program);
  CHECK(program->wait() == 127);
}
