// SPDX-License-Identifier: GPL-3.0-or-later
#include <fcntl.h>
#include <signal.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <catch2/catch.hpp>
#include <chrono>
#include <string>

#include "executives.hpp"
#include "numbered_command.hpp"
#include "orca/idl/motion.hpp"
#include "run/recording/recorder.hpp"
#include "temp_folder.hpp"

using namespace orca;
using namespace orca::host;
using namespace orca::test;
using Catch::Contains;
using Catch::EndsWith;
using Catch::StartsWith;

namespace {

graph::ListedPort listed_port(const std::string& name, Pattern pattern, Role role) {
  graph::ListedPort listed{{"goto", name}, {}, false, {}, {}};
  listed.contract.name = name;
  listed.contract.pattern = pattern;
  listed.contract.role = role;
  listed.contract.type = type_id(object_type<idl::MotionCommand>());
  return listed;
}

std::vector<graph::ListedPort> ports() {
  return {listed_port("out", Pattern::push, Role::server), listed_port("in", Pattern::push, Role::proxy),
          listed_port("order", Pattern::send, Role::proxy),
          listed_port("intake", Pattern::send, Role::server)};
}

std::size_t count_lines(const std::string& text) {
  return static_cast<std::size_t>(std::count(text.begin(), text.end(), '\n'));
}

// Reads what is in a pipe, without waiting.
std::string drain(int fd) {
  std::string text;
  char buffer[65536];
  for (ssize_t count = 0; (count = read(fd, buffer, sizeof buffer)) > 0;)
    text.append(buffer, static_cast<std::size_t>(count));
  return text;
}

}  // namespace

TEST_CASE("each port is recorded where its component's own objects pass", "[host][record]") {
  const TempFolder folder;
  run_on_each(all_executives(), [&](Executive& executive) {
    Recorder recorder(executive);
    REQUIRE(
        recorder
            .open({{folder.file("all.csv"), {"goto.out", "goto.in", "goto.order", "goto.intake"}}}, ports())
            .ok());
    std::uint64_t seq = 0;
    for (const char* name : {"out", "in", "order", "intake", "unknown"}) {
      recorder.pushed("goto", name, numbered_command(++seq));
      recorder.requested("goto", name, numbered_command(++seq));
      recorder.delivered("goto", name, numbered_command(++seq));
      recorder.delivered("other", name, numbered_command(0));
    }
    CHECK(recorder.close().empty());
    recorder.pushed("goto", "out", numbered_command(99));  // too late
  });
  const std::string text = read_text(folder.file("all.csv"));
  CHECK(count_lines(text) == 5);
  for (const char* line :
       {",goto.out,0,,,1,", ",goto.in,0,,,6,", ",goto.order,0,,,8,", ",goto.intake,0,,,12,"})
    CHECK_THAT(text, Contains(line));
}

TEST_CASE("a file without objects has its columns", "[host][record]") {
  const TempFolder folder;
  run_on_each(all_executives(), [&](Executive& executive) {
    Recorder recorder(executive);
    REQUIRE(recorder.open({{folder.file("none.csv"), {"goto.out"}}}, ports()).ok());
    CHECK(recorder.close().empty());
    const std::string text = read_text(folder.file("none.csv"));
    CHECK_THAT(text, StartsWith("stamp,port,creation_time,"));
    CHECK(count_lines(text) == 1);
  });
}

TEST_CASE("in real time nobody waits for a reader that is stuck, and what is left out is counted",
          "[host][record]") {
  const TempFolder folder;
  signal(SIGPIPE, SIG_IGN);
  const std::string pipe = folder.file("pipe.csv");
  REQUIRE(mkfifo(pipe.c_str(), 0600) == 0);
  const int reader = open(pipe.c_str(), O_RDONLY | O_NONBLOCK);
  REQUIRE(reader >= 0);
  constexpr int kObjects = 20000;  // about 3 MB, while a pipe holds 64 KB
  std::string text;
  run_on(steady_executives().front(), [&](Executive& executive) {
    Recorder recorder(executive);
    REQUIRE(recorder.open({{pipe, {"goto.out"}}}, ports()).ok());
    const auto start = std::chrono::steady_clock::now();
    for (int i = 0; i < kObjects; ++i) recorder.pushed("goto", "out", numbered_command(1));
    CHECK(std::chrono::steady_clock::now() - start < std::chrono::seconds(5));

    SECTION("the reader comes back") {
      for (int idle = 0; idle < 10; ++idle) {
        const std::string more = drain(reader);
        if (!more.empty()) idle = 0;
        text += more;
        usleep(20000);
      }
      const std::vector<Error> failures = recorder.close();
      text += drain(reader);
      REQUIRE(failures.size() == 1);
      CHECK(failures.front().code == Code::data_loss);
      const std::size_t written = count_lines(text) - 1;  // without that of the columns
      CHECK(written >= Recorder::kMostWaiting);
      CHECK_THAT(failures.front().message, EndsWith(": " + std::to_string(kObjects - written)));
    }
    SECTION("the reader stays away") {
      const std::vector<Error> failures = recorder.close();
      REQUIRE(failures.size() == 1);
      CHECK(failures.front().code == Code::deadline_exceeded);
      CHECK(std::chrono::steady_clock::now() - start < std::chrono::seconds(5));
    }
  });
  close(reader);
}
