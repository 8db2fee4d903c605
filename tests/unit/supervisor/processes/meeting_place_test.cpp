// SPDX-License-Identifier: GPL-3.0-or-later
#include "orca/supervisor/meeting_place.hpp"

#include <signal.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include <catch2/catch.hpp>
#include <filesystem>

#include "open_descriptors.hpp"
#include "runtime_folder.hpp"

using namespace orca;
using namespace orca::supervisor;
using orca::test::mode_of;
using orca::test::open_descriptors;
using orca::test::RuntimeFolder;
namespace fs = std::filesystem;

TEST_CASE("a process is met at its place, which is for its user alone and gone with it",
          "[supervisor][adoption]") {
  const RuntimeFolder folder;
  const std::size_t before = open_descriptors();
  const fs::path file = folder.path() / "orca" / "scout@left.base.orphan";
  {
    Result<ControlSocket> place = open_meeting_place("scout", "left/base");
    REQUIRE(place);
    CHECK(mode_of(file) == 0600);
    CHECK(waiting_systems() == std::vector<std::string>{"scout"});
    CHECK(running_systems()->empty());
    while (place->accept().value()) continue;  // what asked who waits
    const std::vector<Waiting> found = connect_to_waiting("scout");
    REQUIRE(found.size() == 1);
    CHECK(found[0].pid == getpid());
    CHECK(syscall(SYS_pidfd_send_signal, found[0].pidfd.number(), 0, nullptr, 0) == 0);
    CHECK(place->accept().value());
    CHECK(connect_to_waiting("scou").empty());
    CHECK(connect_to_waiting("scout2").empty());
  }
  CHECK_FALSE(fs::exists(file));
  CHECK(waiting_systems().empty());
  CHECK(connect_to_waiting("scout").empty());
  CHECK(open_descriptors() == before);
}

TEST_CASE("each process of a system has its own place, and no other takes it", "[supervisor][adoption]") {
  const RuntimeFolder folder;
  const Result<ControlSocket> base = open_meeting_place("scout", "base");
  const Result<ControlSocket> brain = open_meeting_place("scout", "brain");
  REQUIRE(base);
  REQUIRE(brain);
  CHECK(connect_to_waiting("scout").size() == 2);
  const Result<ControlSocket> again = open_meeting_place("scout", "base");
  REQUIRE_FALSE(again);
  CHECK(again.error().code == Code::already_exists);
  CHECK(connect_to_waiting("scout").size() == 2);
}

TEST_CASE("the place of a process that was killed is removed by whoever looks", "[supervisor][adoption]") {
  const RuntimeFolder folder;
  const fs::path file = folder.path() / "orca" / "scout@base.orphan";
  const pid_t child = fork();
  if (child == 0) {
    const Result<ControlSocket> place = open_meeting_place("scout", "base");
    raise(SIGKILL);
  }
  REQUIRE(waitpid(child, nullptr, 0) == child);
  REQUIRE(fs::exists(file));
  const bool looks = GENERATE(true, false);
  if (looks)
    CHECK(connect_to_waiting("scout").empty());
  else
    clear_meeting_places("scout");
  CHECK_FALSE(fs::exists(file));
}

TEST_CASE("a process that has no time for destructors removes its place, too", "[supervisor][adoption]") {
  const RuntimeFolder folder;
  const fs::path file = folder.path() / "orca" / "scout@base.orphan";
  const pid_t child = fork();
  if (child == 0) {
    const Result<ControlSocket> place = open_meeting_place("scout", "base");
    remove_meeting_place();
    _exit(place ? 0 : 1);
  }
  int status = -1;
  REQUIRE(waitpid(child, &status, 0) == child);
  CHECK(status == 0);
  CHECK(fs::is_empty(file.parent_path()));
}
