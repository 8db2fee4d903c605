// SPDX-License-Identifier: GPL-3.0-or-later
#include "orca/supervisor/control_socket.hpp"

#include <signal.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <catch2/catch.hpp>
#include <filesystem>
#include <fstream>
#include <optional>
#include <vector>

#include "open_descriptors.hpp"
#include "runtime_folder.hpp"

using namespace orca;
using namespace orca::supervisor;
using orca::test::mode_of;
using orca::test::open_descriptors;
using orca::test::RuntimeFolder;
namespace fs = std::filesystem;

TEST_CASE("a system's socket is for its user alone, and is gone with the system", "[supervisor][control]") {
  const RuntimeFolder folder;
  const std::size_t before = open_descriptors();
  {
    Result<ControlSocket> socket = ControlSocket::open("scout");
    REQUIRE(socket);
    CHECK(mode_of(folder.socket("scout")) == 0600);
    CHECK(mode_of(folder.socket("scout").parent_path()) == 0700);
    CHECK(*running_systems() == std::vector<std::string>{"scout"});
    const Result<Descriptor> client = connect_to_system("scout");
    REQUIRE(client);
    const Result<Descriptor> accepted = socket->accept();
    REQUIRE(accepted);
    CHECK(*accepted);
    CHECK(connect_to_system("pioneer").error().code == Code::not_found);
  }
  CHECK_FALSE(fs::exists(folder.socket("scout")));
  CHECK(running_systems()->empty());
  CHECK(connect_to_system("scout").error().code == Code::not_found);
  CHECK(open_descriptors() == before);
}

TEST_CASE("a living system of the same name is not disturbed", "[supervisor][control]") {
  const RuntimeFolder folder;
  const Result<ControlSocket> first = ControlSocket::open("scout");
  REQUIRE(first);
  const Result<ControlSocket> second = ControlSocket::open("scout");
  REQUIRE_FALSE(second);
  CHECK(second.error().code == Code::already_exists);
  CHECK(connect_to_system("scout"));
}

TEST_CASE("a socket that a dead system has left is replaced", "[supervisor][control]") {
  const RuntimeFolder folder;
  std::optional<ControlSocket> first(std::move(ControlSocket::open("scout")).value());
  fs::rename(folder.socket("scout"), folder.path() / "kept");
  first.reset();
  fs::rename(folder.path() / "kept", folder.socket("scout"));
  CHECK(running_systems()->empty());
  const Result<ControlSocket> second = ControlSocket::open("scout");
  REQUIRE(second);
  CHECK(connect_to_system("scout"));
}

TEST_CASE("a system whose killed predecessor's forks are still about to end waits for them",
          "[supervisor][control]") {
  const RuntimeFolder folder;
  int opened[2];
  REQUIRE(pipe(opened) == 0);
  const pid_t first = fork();
  if (first == 0) {
    const Result<ControlSocket> socket = ControlSocket::open("scout");
    if (fork() == 0)
      usleep(300'000);  // holds the socket like a child that has not come to its exec
    else if (socket && write(opened[1], "o", 1) == 1)
      pause();
    _exit(0);
  }
  char byte = 0;
  REQUIRE(read(opened[0], &byte, 1) == 1);
  REQUIRE(kill(first, SIGKILL) == 0);
  const bool is_reaped = GENERATE(true, false);
  siginfo_t end{};
  REQUIRE(waitid(P_PID, static_cast<id_t>(first), &end, WEXITED | (is_reaped ? 0 : WNOWAIT)) == 0);
  CHECK(ControlSocket::open("scout"));
  if (!is_reaped) CHECK(waitpid(first, nullptr, 0) == first);
  close(opened[0]);
  close(opened[1]);
}

TEST_CASE("a folder that others may write to is not used", "[supervisor][control]") {
  const RuntimeFolder folder;
  fs::create_directory(folder.path() / "orca");
  fs::permissions(folder.path() / "orca", fs::perms::all);
  const Result<ControlSocket> socket = ControlSocket::open("scout");
  REQUIRE_FALSE(socket);
  CHECK(socket.error().code == Code::unavailable);
  CHECK_THAT(socket.error().message, Catch::Contains("does not belong to this user alone"));
}

TEST_CASE("a name that is too long for a socket is an error", "[supervisor][control]") {
  const RuntimeFolder folder;
  CHECK(ControlSocket::open(std::string(120, 'a')).error().code == Code::unavailable);
}

TEST_CASE("a folder that is none, or leads elsewhere, is not used, and nobody is found in it",
          "[supervisor][control]") {
  const RuntimeFolder folder;
  const fs::path place = folder.path() / "orca";
  SECTION("a link to a folder of this user") {
    fs::create_directory(folder.path() / "elsewhere");
    fs::permissions(folder.path() / "elsewhere", fs::perms::owner_all);
    fs::create_directory_symlink(folder.path() / "elsewhere", place);
  }
  SECTION("a link to nothing") { fs::create_symlink(folder.path() / "nothing", place); }
  SECTION("a file") { std::ofstream(place) << "x"; }
  for (const Code code : {ControlSocket::open("scout").error().code, connect_to_system("scout").error().code,
                          running_systems().error().code})
    CHECK(code == Code::unavailable);
  CHECK_THAT(connect_to_system("scout").error().message, Catch::Contains(place.string()));
  CHECK_FALSE(fs::exists(folder.path() / "elsewhere" / "scout.sock"));
}

TEST_CASE("a folder in one that others may write to is not used, because they could exchange it",
          "[supervisor][control]") {
  const RuntimeFolder folder;
  fs::permissions(folder.path(), fs::perms::all);
  CHECK(ControlSocket::open("scout").error().code == Code::unavailable);
  CHECK(connect_to_system("scout").error().code == Code::unavailable);
  fs::permissions(folder.path(), fs::perms::all | fs::perms::sticky_bit);
  CHECK(ControlSocket::open("scout"));
}

TEST_CASE("a socket whose file was removed keeps its name, and is made again", "[supervisor][control]") {
  const RuntimeFolder folder;
  Result<ControlSocket> first = ControlSocket::open("scout");
  REQUIRE(first);
  CHECK_FALSE(*first->restore());
  SECTION("the file") { fs::remove(folder.socket("scout")); }
  SECTION("the folder") { fs::remove_all(folder.path() / "orca"); }
  SECTION("something else is in its place") {
    fs::remove(folder.socket("scout"));
    std::ofstream(folder.socket("scout")) << "x";
  }
  CHECK(ControlSocket::open("scout").error().code == Code::already_exists);
  CHECK(*first->restore());
  CHECK(mode_of(folder.socket("scout")) == 0600);
  CHECK(connect_to_system("scout"));
  CHECK(*first->accept());
}

TEST_CASE("a system that takes nobody in is too busy, and neither gone nor a reason to give up everything",
          "[supervisor][control]") {
  const RuntimeFolder folder;
  const Result<ControlSocket> socket = ControlSocket::open("scout");
  REQUIRE(socket);
  std::vector<Descriptor> crowd;
  while (Result<Descriptor> one = connect_to_system("scout")) crowd.push_back(std::move(one).value());
  CHECK(crowd.size() > 100);
  CHECK(connect_to_system("scout").error().code == Code::unavailable);
  CHECK(*running_systems() == std::vector<std::string>{"scout"});
  CHECK(ControlSocket::open("scout").error().code == Code::already_exists);
}
