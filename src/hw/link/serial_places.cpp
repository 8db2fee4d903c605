// SPDX-License-Identifier: LGPL-3.0-or-later
#include "serial_places.hpp"

#include <algorithm>
#include <filesystem>

namespace orca::hw::link {
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
