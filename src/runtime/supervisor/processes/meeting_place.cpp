// SPDX-License-Identifier: LGPL-3.0-or-later
#include "orca/supervisor/meeting_place.hpp"

#include <sys/socket.h>
#include <sys/syscall.h>
#include <sys/un.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <optional>
#include <set>

namespace orca::supervisor {
namespace {

constexpr const char* kOrphanSuffix = ".orphan";
constexpr char kBetween = '@';  // is in no name

// The path of this process's own place, for remove_meeting_place().
std::array<char, sizeof sockaddr_un::sun_path> g_own{};

// The name of a process may have contexts, "left/base".
std::string file_of(const std::string& system, std::string process) {
  std::ranges::replace(process, '/', '.');
  return system + kBetween + process + kOrphanSuffix;
}

// In a folder that cannot be trusted is nobody: a deployer is not started there either.
std::vector<std::string> files_in_folder() { return files_of_user(kOrphanSuffix).value_or({}); }

std::string system_of(const std::string& file) { return file.substr(0, file.find(kBetween)); }

// Tells which process listens at the other end.
std::optional<Waiting> look_at(Descriptor connection) {
  const std::optional<ucred> peer = peer_of(connection);
  if (!peer || peer->uid != geteuid()) return std::nullopt;
  Descriptor pidfd(static_cast<int>(syscall(SYS_pidfd_open, peer->pid, 0)));
  if (!pidfd) return std::nullopt;
  return Waiting{peer->pid, std::move(pidfd), std::move(connection)};
}

}  // namespace

Result<ControlSocket> open_meeting_place(const std::string& system, const std::string& process) {
  Result<ControlSocket> place =
      ControlSocket::open_file(file_of(system, process),
                               fail(Code::already_exists, "another process \"" + process + "\" of system \"" +
                                                              system + "\" waits for a deployer already"));
  if (place) std::strncpy(g_own.data(), place->path().c_str(), g_own.size() - 1);
  return place;
}

void remove_meeting_place() noexcept {
  if (g_own[0] != '\0') unlink(g_own.data());
}

std::vector<Waiting> connect_to_waiting(const std::string& system) {
  std::vector<Waiting> all;
  for (const std::string& file : files_in_folder()) {
    if (system_of(file) != system) continue;
    Result<Descriptor> connection = connect_to_file(file);
    if (!connection) {
      remove_dead_file(file);
      continue;
    }
    if (auto waiting = look_at(std::move(connection).value())) all.push_back(std::move(*waiting));
  }
  return all;
}

void clear_meeting_places(const std::string& system) {
  for (const std::string& file : files_in_folder())
    if (system_of(file) == system) remove_dead_file(file);
}

std::vector<std::string> waiting_systems() {
  std::set<std::string> names;
  for (const std::string& file : files_in_folder())
    if (connect_to_file(file)) names.insert(system_of(file));
  return {names.begin(), names.end()};
}

}  // namespace orca::supervisor
