// SPDX-License-Identifier: LGPL-3.0-or-later
#include "serial_trouble.hpp"

#include <grp.h>
#include <pwd.h>
#include <sys/stat.h>
#include <unistd.h>
#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <vector>

#include "orca/base/text.hpp"

namespace orca::hw::link {
namespace {

namespace files = std::filesystem;

bool is_number(const std::string& text) {
  return !text.empty() && text.find_first_not_of("0123456789") == std::string::npos;
}

// Whether one of the open descriptors of a process leads to `real`; its folder may be closed to us.
bool holds(const files::path& process, const std::string& real) {
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

Error explain_absence(const std::string& path, const SerialPlaces& places, const std::string& name) {
  const std::vector<std::string> there = places.adapters();
  const std::string others = there.empty() ? "no serial adapter is plugged in"
                                           : "the serial adapters that are plugged in: " + listed(there);
  return fail(Code::not_found, "there is no " + path + ". Is the adapter plugged in? Now " + others, name);
}

}  // namespace

Error explain_refusal(const std::string& path, int reason, const SerialPlaces& places,
                      const std::string& name) {
  switch (reason) {
    case ENOENT:
    case ENOTDIR: return explain_absence(path, places, name);
    case EACCES:
    case EPERM: return explain_permission(path, name);
    case EBUSY: return explain_holder(path, name);
    case ENXIO:
    case ENODEV:
    case EIO:
      return fail(Code::not_found,
                  path + " exists, but no serial port is behind it; is the adapter plugged in?", name);
    default: return fail(Code::unavailable, "cannot open " + path + ": " + std::strerror(reason), name);
  }
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

namespace fs = std::filesystem;

std::string resolved(const std::string& path) {
  std::error_code none;
  const fs::path real = fs::canonical(path, none);
  return none ? std::string() : real.string();
}

std::string SerialPlaces::path_of(const std::string& device) const {
  if (device.find('/') != std::string::npos) return device;
  for (const char* kind : {"/by-id/", "/by-path/"}) {
    std::string path = folder_ + kind + device;
    if (!resolved(path).empty()) return path;
  }
  return "/dev/" + device;
}

std::string SerialPlaces::identity_of(const std::string& path) const {
  const std::string real = resolved(path);
  if (real.empty()) return {};
  const std::vector<std::string> all = adapters();
  const auto same =
      std::ranges::find_if(all, [&](const std::string& link) { return resolved(link) == real; });
  return same == all.end() ? std::string() : *same;
}

std::vector<std::string> SerialPlaces::adapters() const {
  std::vector<std::string> found;
  std::error_code none;
  for (fs::directory_iterator entry(folder_ + "/by-id", none), end; !none && entry != end;
       entry.increment(none))
    found.push_back(entry->path().string());
  std::ranges::sort(found);
  return found;
}

}  // namespace orca::hw::link
