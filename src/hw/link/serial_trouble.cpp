// SPDX-License-Identifier: LGPL-3.0-or-later
#include "serial_trouble.hpp"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <vector>

#include "orca/base/text.hpp"
#include "orca/hw/link/device_files.hpp"

namespace orca::hw::link {
namespace {

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

namespace fs = std::filesystem;

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
