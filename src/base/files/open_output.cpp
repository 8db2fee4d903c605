// SPDX-License-Identifier: LGPL-3.0-or-later
#include "orca/base/files/open_output.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

#include "orca/base/exhaustion.hpp"

namespace orca {
namespace {

std::string folder_of(const std::string& path) {
  const std::size_t end = path.find_last_not_of('/');
  const std::size_t slash = end == std::string::npos ? end : path.rfind('/', end);
  if (slash == std::string::npos) return path.starts_with('/') ? "/" : ".";
  return path.substr(0, slash + 1);
}

std::string without_slash(std::string path) {
  while (path.size() > 1 && path.ends_with('/')) path.pop_back();
  return path;
}

// Checks an entry of a folder that everybody may write to: it must be this user's, or the folder owner's.
Status check(const struct stat& found, const struct stat& folder) {
  const auto refuse = [](const std::string& what) {
    return fail(Code::unavailable, what + ", in a folder that everybody may write to; choose another name");
  };
  if (found.st_uid != geteuid() && found.st_uid != folder.st_uid)
    return refuse("user " + std::to_string(found.st_uid) + " has put something in this place");
  if (S_ISREG(found.st_mode) && found.st_nlink > 1)
    return refuse("this file has a second name, under which it may be another one");
  return ok();
}

bool is_open_to_all(const std::string& path, struct stat& folder) {
  return stat(path.c_str(), &folder) == 0 && (folder.st_mode & S_IWOTH) != 0;
}

Error cannot_open(int reason) {
  throw_if_exhausted(reason);
  return fail(Code::unavailable, reason == ENXIO ? "nobody reads this pipe" : std::strerror(reason));
}

}  // namespace

Status check_output_place(const std::string& path) {
  struct stat folder {};
  struct stat found {};
  if (!is_open_to_all(folder_of(path), folder)) return ok();
  if (lstat(without_slash(path).c_str(), &found) != 0) return ok();
  return check(found, folder);
}

Result<OpenOutput> open_output(const std::string& path, int flags, mode_t mode) {
  Descriptor made(open(path.c_str(), flags | O_CREAT | O_EXCL, mode));
  if (made) return OpenOutput{std::move(made), true};
  if (errno != EEXIST) return cannot_open(errno);
  if (Status trusted = check_output_place(path); !trusted.ok()) return trusted.error();
  Descriptor old(open(path.c_str(), flags | O_CREAT, mode));
  if (!old) return cannot_open(errno);
  return OpenOutput{std::move(old), false};
}

}  // namespace orca
