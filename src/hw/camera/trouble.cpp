// SPDX-License-Identifier: LGPL-3.0-or-later
#include "trouble.hpp"

#include <cerrno>
#include <cstring>
#include <vector>

#include "orca/base/text.hpp"
#include "orca/hw/link/device_files.hpp"

namespace orca::hw::camera {
namespace {

std::string plugged_in() {
  const std::vector<std::string> there = link::cameras();
  return there.empty() ? "now no camera is plugged in" : "cameras that are plugged in: " + listed(there);
}

}  // namespace

Error explain_refusal(const std::string& path, int reason) {
  switch (reason) {
    case ENOENT:
    case ENOTDIR:
      return fail(Code::not_found, "there is no " + path + "; is the camera plugged in? " + plugged_in());
    case EACCES:
    case EPERM: return link::explain_permission(path, "");
    case EBUSY: return link::explain_holder(path, "");
    case ENOTTY:
    case EINVAL: return fail(Code::invalid_argument, path + " is no camera; " + plugged_in());
    case ENXIO:
    case ENODEV:
    case EIO:
      return fail(Code::not_found,
                  path + " exists, but no camera is behind it; is it plugged in? " + plugged_in());
    default: return fail(Code::unavailable, "cannot open " + path + ": " + std::strerror(reason));
  }
}

Error explain_no_camera(const std::string& path, const std::string& card, const std::string& why) {
  return fail(Code::invalid_argument, path + " (" + card + ") " + why + "; " + plugged_in());
}

}  // namespace orca::hw::camera
