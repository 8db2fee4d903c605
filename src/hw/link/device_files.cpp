// SPDX-License-Identifier: LGPL-3.0-or-later
#include "orca/hw/link/device_files.hpp"

#include <grp.h>
#include <pwd.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <fstream>
#include <set>

#include "orca/base/text.hpp"

namespace orca::hw::link {
namespace {

namespace files = std::filesystem;

bool is_number(const std::string& text) {
  return !text.empty() && text.find_first_not_of("0123456789") == std::string::npos;
}

// Whether one of the open descriptors of a process leads to `real`; its folder may be closed to us. Nobody holds what is not there.
bool holds(const files::path& process, const std::string& real) {
  if (real.empty()) return false;
  std::error_code none;
  for (files::directory_iterator entry(process / "fd", none), end; !none && entry != end;
       entry.increment(none)) {
    std::error_code unreadable;
    if (files::read_symlink(entry->path(), unreadable) == real) return true;
  }
  return false;
}

std::string program_of(const files::path& process) {
  std::ifstream file(process / "comm");
  std::string name;
  std::getline(file, name);
  return name.empty() ? "unknown" : printable(name);
}

// "minicom (process 123)" for each process that has the device open.
std::vector<std::string> holders_of(const std::string& path) {
  const std::string real = resolved(path);
  std::vector<std::string> found;
  std::error_code none;
  for (files::directory_iterator entry("/proc", none), end; !none && entry != end; entry.increment(none)) {
    const std::string number = entry->path().filename().string();
    if (is_number(number) && holds(entry->path(), real))
      found.push_back(program_of(entry->path()) + " (process " + number + ")");
  }
  return found;
}

std::string name_of_group(gid_t id) {
  std::array<char, 4096> room{};
  group entry{};
  group* found = nullptr;
  if (getgrgid_r(id, &entry, room.data(), room.size(), &found) == 0 && found != nullptr)
    return found->gr_name;
  return std::to_string(id);
}

std::string name_of_user(uid_t id) {
  std::array<char, 4096> room{};
  passwd entry{};
  passwd* found = nullptr;
  if (getpwuid_r(id, &entry, room.data(), room.size(), &found) == 0 && found != nullptr)
    return found->pw_name;
  return std::to_string(id);
}

// Returns the paths in a folder, sorted; none if there is no such folder.
std::vector<files::path> entries(const files::path& folder) {
  std::vector<files::path> found;
  std::error_code none;
  for (files::directory_iterator entry(folder, none), end; !none && entry != end; entry.increment(none))
    found.push_back(entry->path());
  std::ranges::sort(found);
  return found;
}

}  // namespace

std::string resolved(const std::string& path) {
  std::error_code none;
  const files::path real = files::canonical(path, none);
  return none ? std::string() : real.string();
}

Error explain_holder(const std::string& path, const std::string& name) {
  if (holds("/proc/self", resolved(path)))
    return fail(Code::unavailable,
                path + " is in use by this program itself, for another device; each needs a line of its own",
                name);
  const std::vector<std::string> holders = holders_of(path);
  const std::string who =
      holders.empty() ? "another program, which only root can see (sudo fuser " + in_shell_quotes(path) + ")"
                      : listed(holders);
  return fail(Code::unavailable, path + " is in use by " + who + "; end that program first", name);
}

Error explain_permission(const std::string& path, const std::string& name) {
  struct stat about {};
  const std::string user = name_of_user(geteuid());
  const std::string who = "the user " + user + " may not open " + path;
  constexpr unsigned kGroupMay = S_IRGRP | S_IWGRP;
  if (stat(path.c_str(), &about) != 0 || (about.st_mode & kGroupMay) != kGroupMay)
    return fail(Code::failed_precondition,
                who + ", and no group may; ask who looks after this machine for access to it", name);
  const std::string group = name_of_group(about.st_gid);
  return fail(Code::failed_precondition,
              who + "; the group " + group + " may: sudo usermod -aG " + group + " " + user +
                  ", then log out and in again",
              name);
}

bool is_camera(const std::string& path) {
  const std::string real = resolved(path);
  return files::path(real.empty() ? path : real).filename().string().starts_with("video");
}

std::vector<std::string> cameras(const std::string& folder) {
  std::vector<std::string> found;
  std::set<std::string> named;
  for (const files::path& name : entries(files::path(folder) / "v4l/by-id")) {
    named.insert(resolved(name));
    if (name.string().ends_with("-index0")) found.push_back(name);
  }
  for (const files::path& path : entries(folder))
    if (path.filename().string().starts_with("video") && !named.contains(resolved(path)))
      found.push_back(path);
  return found;
}

}  // namespace orca::hw::link
