// SPDX-License-Identifier: LGPL-3.0-or-later
#include "orca/base/files/trusted_code.hpp"

#include <grp.h>
#include <pwd.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <set>
#include <string_view>

#include "orca/base/exhaustion.hpp"
#include "orca/base/text.hpp"

namespace orca {
namespace {

namespace fs = std::filesystem;

// Whoever owns the program decides anyway what it does: a checkout of one user that root runs, as in a container.
std::set<uid_t> trusted_users() {
  std::set<uid_t> users{0, geteuid()};
  struct stat program {};
  if (stat("/proc/self/exe", &program) == 0) users.insert(program.st_uid);
  return users;
}

// A user's private group has the user's name and nobody else in it.
bool is_private_group(gid_t group, uid_t user) {
  std::array<char, 16384> user_room{};
  std::array<char, 16384> group_room{};
  passwd owner{};
  passwd* found_owner = nullptr;
  struct group entry {};
  struct group* found = nullptr;
  if (getpwuid_r(user, &owner, user_room.data(), user_room.size(), &found_owner) != 0 ||
      found_owner == nullptr)
    return false;
  if (getgrgid_r(group, &entry, group_room.data(), group_room.size(), &found) != 0 || found == nullptr)
    return false;
  const std::string_view name = owner.pw_name;
  if (owner.pw_gid != group || name != entry.gr_name) return false;
  for (char** member = entry.gr_mem; *member != nullptr; ++member)
    if (name != *member) return false;
  return true;
}

Error refuse(const std::string& path, const std::string& what, const std::string& remedy) {
  return fail(Code::failed_precondition,
              path + " " + what + ", who could exchange the code that would run; " + remedy);
}

Status check(const fs::path& path, const struct stat& found) {
  const std::string name = path.string();
  if (!trusted_users().contains(found.st_uid))
    return refuse(name, "belongs to user " + std::to_string(found.st_uid),
                  "run: sudo chown " + std::to_string(geteuid()) + " " + in_shell_quotes(name));
  const bool keeps_apart = S_ISDIR(found.st_mode) && (found.st_mode & S_ISVTX) != 0;
  if (keeps_apart) return ok();
  if ((found.st_mode & S_IWOTH) != 0)
    return refuse(name, "can be written to by everybody", "run: chmod go-w " + in_shell_quotes(name));
  if ((found.st_mode & S_IWGRP) != 0 && !is_private_group(found.st_gid, found.st_uid))
    return refuse(name, "can be written to by group " + std::to_string(found.st_gid),
                  "run: chmod g-w " + in_shell_quotes(name));
  return ok();
}

// Returns whether a folder is one of those above the program that runs: whoever can exchange things there can exchange the program.
bool holds_program(const fs::path& folder) {
  std::error_code unused;
  const fs::path program = fs::read_symlink("/proc/self/exe", unused);
  return std::mismatch(folder.begin(), folder.end(), program.begin(), program.end()).first == folder.end();
}

// Checks a path and all folders above it, up to one that the program is in as well.
Status check_all(fs::path path) {
  for (; !holds_program(path); path = path.parent_path()) {
    struct stat found {};
    if (stat(path.c_str(), &found) != 0) {
      const int reason = errno;
      throw_if_exhausted(reason);
      return fail(reason == ENOENT ? Code::not_found : Code::failed_precondition,
                  "cannot look at " + path.string() + ": " + std::strerror(reason));
    }
    if (Status trusted = check(path, found); !trusted.ok()) return trusted;
  }
  return ok();
}

}  // namespace

Status check_trusted_code(const std::string& file) {
  std::error_code unused;
  const fs::path named = fs::absolute(file, unused).lexically_normal();
  if (Status trusted = check_all(named); !trusted.ok()) return trusted;
  const fs::path real = fs::canonical(named, unused);
  return real == named || real.empty() ? ok() : check_all(real);
}

}  // namespace orca
