// SPDX-License-Identifier: GPL-3.0-or-later
#include "orca/supervisor/control_socket.hpp"

#include <catch2/catch.hpp>
#include <filesystem>
#include <optional>

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
    CHECK(running_systems() == std::vector<std::string>{"scout"});
    const Result<Descriptor> client = connect_to_system("scout");
    REQUIRE(client);
    const Result<Descriptor> accepted = socket->accept();
    REQUIRE(accepted);
    CHECK(*accepted);
    CHECK(connect_to_system("pioneer").error().code == Code::not_found);
  }
  CHECK_FALSE(fs::exists(folder.socket("scout")));
  CHECK(running_systems().empty());
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
  CHECK(running_systems().empty());
  const Result<ControlSocket> second = ControlSocket::open("scout");
  REQUIRE(second);
  CHECK(connect_to_system("scout"));
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
