// SPDX-License-Identifier: LGPL-3.0-or-later
#include "orca/base/files/own_library.hpp"

#include <dlfcn.h>

#include <filesystem>

namespace orca {

std::string beside_own_library(const std::string& name) {
  Dl_info own{};
  if (dladdr(reinterpret_cast<const void*>(&beside_own_library), &own) == 0) return name;
  return (std::filesystem::path(own.dli_fname).parent_path() / name).string();
}

}  // namespace orca
