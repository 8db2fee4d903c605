// SPDX-License-Identifier: LGPL-3.0-or-later
#include "control/code_watch.hpp"

#include <sys/stat.h>

#include <chrono>

namespace orca::supervisor {
namespace {

constexpr std::chrono::milliseconds kSettled{100};

}  // namespace

std::vector<std::string> CodeWatch::changed(const std::set<std::string>& files, Moment now) {
  std::vector<std::string> all;
  for (const std::string& file : files) {
    const std::optional<Identity> identity = identity_of(file);
    const auto [known, is_new] = files_.try_emplace(file, File{identity, identity, now});
    if (!is_new && has_changed(known->second, identity, now)) all.push_back(file);
  }
  return all;
}

std::optional<CodeWatch::Identity> CodeWatch::identity_of(const std::string& file) {
  struct stat status {};
  if (stat(file.c_str(), &status) != 0) return std::nullopt;
  return Identity{static_cast<std::int64_t>(status.st_dev), static_cast<std::int64_t>(status.st_ino),
                  status.st_size, status.st_mtim.tv_sec, status.st_mtim.tv_nsec};
}

bool CodeWatch::has_changed(File& file, const std::optional<Identity>& identity, Moment now) {
  if (identity != file.seen) {
    file.seen = identity;
    file.since = now;
  }
  if (!identity || identity == file.known || now - file.since < kSettled) return false;
  file.known = identity;
  return true;
}

}  // namespace orca::supervisor
