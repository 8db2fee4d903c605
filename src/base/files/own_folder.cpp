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

// The place of what is to stay; its parent is empty if there is none.
Place place_of_state() {
  const char* const state = std::getenv("XDG_STATE_HOME");
  const char* const home = std::getenv("HOME");
  if (state != nullptr && state[0] == '/') return {state, "orca"};
  if (home != nullptr && home[0] == '/') return {std::string(home) + "/.local/state", "orca"};
  return {};
}

// Makes a folder and those above it, for this user alone.
Status make_folders(const std::string& path) {
  for (std::size_t end = path.find('/', 1);; end = path.find('/', end + 1)) {
    const std::string part = path.substr(0, end);
    if (mkdir(part.c_str(), S_IRWXU) != 0 && errno != EEXIST) return refused("cannot make", part, errno);
    if (end == std::string::npos) return ok();
  }
}

Result<Descriptor> open_place(const Place& place, const std::string& path, bool makes) {
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
  Result<Descriptor> folder = open_place(place_of_user(), path, false);
  if (!folder) return folder.error();
  return OwnFolder(std::move(folder).value(), std::move(path));
}

Result<OwnFolder> OwnFolder::make() {
  std::string path = path_of_user();
  Result<Descriptor> folder = open_place(place_of_user(), path, true);
  if (!folder) return folder.error();
  return OwnFolder(std::move(folder).value(), std::move(path));
}

std::string OwnFolder::path_for_state() {
  const Place place = place_of_state();
  return place.parent.empty() ? "" : place.parent + "/" + place.name;
}

Result<OwnFolder> OwnFolder::make_for_state() {
  std::string path = path_for_state();
  if (path.empty())
    return fail(Code::unavailable,
                "there is no folder for what is kept: neither XDG_STATE_HOME nor HOME is set");
  if (Status made = make_folders(place_of_state().parent); !made.ok()) return made.error();
  Result<Descriptor> folder = open_place(place_of_state(), path, true);
  if (!folder) return folder.error();
  return OwnFolder(std::move(folder).value(), std::move(path));
}

Result<OwnFolder> OwnFolder::make_for_components() {
  if (const Result<OwnFolder> state = make_for_state(); !state) return state.error();
  std::string path = path_for_state() + "/kept";
  Result<Descriptor> folder = open_place({path_for_state(), "kept"}, path, true);
  if (!folder) return folder.error();
  return OwnFolder(std::move(folder).value(), std::move(path));
}

}  // namespace orca
