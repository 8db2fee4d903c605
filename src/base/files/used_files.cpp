// SPDX-License-Identifier: LGPL-3.0-or-later
#include "used_files.hpp"

#include <algorithm>
#include <filesystem>

namespace orca {
namespace {

// Returns the path without links, because the process may change its working folder, and "/dev/fd/3" soon leads
// elsewhere.
std::string canonical(const std::string& path) {
  std::error_code unused;
  return std::filesystem::weakly_canonical(path, unused).string();
}

bool leads_to(const std::string& path, const struct stat& file) {
  struct stat found {};
  return stat(path.c_str(), &found) == 0 && found.st_dev == file.st_dev && found.st_ino == file.st_ino;
}

bool any_leads_to(const std::set<std::string>& paths, const struct stat& file) {
  return std::ranges::any_of(paths, [&](const std::string& path) { return leads_to(path, file); });
}

}  // namespace

UsedFiles& UsedFiles::of_process() {
  static auto& files = *new UsedFiles;  // never destroyed: threads may read while the process ends
  return files;
}

void UsedFiles::add_read(const std::string& path) {
  const std::lock_guard lock(mutex_);
  read_.insert(canonical(path));
}

void UsedFiles::add_named(const std::string& path) {
  const std::lock_guard lock(mutex_);
  named_.insert(canonical(path));
}

void UsedFiles::add_written(const std::string& path, const std::string& what) {
  const std::lock_guard lock(mutex_);
  written_.emplace(canonical(path), what);
}

void UsedFiles::remove_written(const std::string& path) {
  const std::lock_guard lock(mutex_);
  written_.erase(canonical(path));
}

std::vector<std::string> UsedFiles::inputs() const {
  const std::lock_guard lock(mutex_);
  std::set<std::string> all = read_;
  all.insert(named_.begin(), named_.end());
  return {all.begin(), all.end()};
}

bool UsedFiles::is_read(const struct stat& file) const {
  const std::lock_guard lock(mutex_);
  return any_leads_to(read_, file);
}

std::string UsedFiles::use_of(const struct stat& file) const {
  const std::lock_guard lock(mutex_);
  if (any_leads_to(read_, file)) return "a file that has been read";
  if (any_leads_to(named_, file)) return "a file that the graph names";
  for (const auto& [path, what] : written_)
    if (leads_to(path, file)) return what;
  return {};
}

}  // namespace orca
