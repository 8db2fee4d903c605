// SPDX-License-Identifier: LGPL-3.0-or-later
#include "orca/base/files/own_folder.hpp"

#include <fcntl.h>
#include <sys/stat.h>

#include <cerrno>
#include <cstdlib>
#include <cstring>

#include "orca/base/exhaustion.hpp"

namespace orca {
namespace {

constexpr mode_t kOthersWrite = S_IWGRP | S_IWOTH;
constexpr mode_t kOthers = S_IRWXG | S_IRWXO;

// The place of the user's folder.
struct Place {
  std::string parent;
  std::string name;
};

Place place_of_user() {
  const char* const runtime = std::getenv("XDG_RUNTIME_DIR");
  struct stat found {};
  if (runtime != nullptr && runtime[0] == '/' && stat(runtime, &found) == 0 && S_ISDIR(found.st_mode))
    return {runtime, "orca"};
  return {"/tmp", "orca-" + std::to_string(geteuid())};
}

Error refused(const std::string& what, const std::string& path, int reason) {
  throw_if_exhausted(reason);
  return fail(reason == ENOENT ? Code::not_found : Code::unavailable,
              what + " the folder " + path + ": " + std::strerror(reason));
}

Error untrusted(const std::string& path, const std::string& why) {
  return fail(Code::unavailable, "the folder " + path + " " + why);
}

std::string owner(const struct stat& found) { return "belongs to user " + std::to_string(found.st_uid); }

// Whoever can rename the folder can put another one in its place.
Result<Descriptor> open_parent(const std::string& path) {
  Descriptor parent(::open(path.c_str(), O_PATH | O_DIRECTORY | O_CLOEXEC));
  struct stat found {};
  if (!parent || fstat(parent.number(), &found) != 0) return refused("cannot open", path, errno);
  if (found.st_uid != 0 && found.st_uid != geteuid())
    return untrusted(
        path,
        owner(found) + ", who could exchange what is in it; set XDG_RUNTIME_DIR to a folder of your own");
  if ((found.st_mode & kOthersWrite) != 0 && (found.st_mode & S_ISVTX) == 0)
    return untrusted(
        path,
        "can be written to by others, who could exchange what is in it; let only its owner write "
        "to it (chmod go-w), or let each user keep what is theirs (chmod +t)");
  return parent;
}

// Opens a folder of the user alone. It is looked at before it is opened: another user's cannot be.
Result<Descriptor> open_proven(int parent, const std::string& name, const std::string& path) {
  const Descriptor seen(openat(parent, name.c_str(), O_PATH | O_DIRECTORY | O_NOFOLLOW | O_CLOEXEC));
  struct stat found {};
  if (!seen && (errno == ENOTDIR || errno == ELOOP))
    return untrusted(path, "is a symbolic link or no folder; remove it");
  if (!seen || fstat(seen.number(), &found) != 0) return refused("cannot look at", path, errno);
  if (found.st_uid != geteuid())
    return untrusted(path, "does not belong to this user alone: it " + owner(found) +
                               "; have it removed, or set XDG_RUNTIME_DIR to a folder of your own");
  if ((found.st_mode & kOthers) != 0)
    return untrusted(path,
                     "does not belong to this user alone: others have rights to it; remove it, or take them "
                     "away (chmod 700)");
  Descriptor folder(openat(seen.number(), ".", O_RDONLY | O_DIRECTORY | O_CLOEXEC));
  if (!folder) return refused("cannot open", path, errno);
  return folder;
}

Status make_folder(int parent, const std::string& name, const std::string& path) {
  if (mkdirat(parent, name.c_str(), S_IRWXU) == 0 || errno == EEXIST) return ok();
  const int reason = errno;
  throw_if_exhausted(reason);
  return fail(Code::unavailable, "cannot make the folder " + path + ": " + std::strerror(reason));
}

Result<Descriptor> open_of_user(const std::string& path, bool makes) {
  const Place place = place_of_user();
  const Result<Descriptor> parent = open_parent(place.parent);
  if (!parent) return parent.error();
  if (makes)
    if (Status made = make_folder(parent->number(), place.name, path); !made.ok()) return made.error();
  return open_proven(parent->number(), place.name, path);
}

}  // namespace

std::string OwnFolder::path_of_user() {
  const Place place = place_of_user();
  return place.parent + "/" + place.name;
}

Result<OwnFolder> OwnFolder::open() {
  std::string path = path_of_user();
  Result<Descriptor> folder = open_of_user(path, false);
  if (!folder) return folder.error();
  return OwnFolder(std::move(folder).value(), std::move(path));
}

Result<OwnFolder> OwnFolder::make() {
  std::string path = path_of_user();
  Result<Descriptor> folder = open_of_user(path, true);
  if (!folder) return folder.error();
  return OwnFolder(std::move(folder).value(), std::move(path));
}

}  // namespace orca
