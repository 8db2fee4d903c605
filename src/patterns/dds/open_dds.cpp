// SPDX-License-Identifier: LGPL-3.0-or-later
#include <dlfcn.h>

#include <utility>

#include "orca/patterns/dds/dds_backend.hpp"

namespace orca {

Result<std::unique_ptr<DdsBackend>> open_dds(const std::string& library, const DdsOptions& options) {
  void* const opened = dlopen(library.c_str(), RTLD_NOW | RTLD_LOCAL | RTLD_NODELETE);
  if (opened == nullptr)
    return fail(Code::unavailable, std::string("the link dds cannot be used: ") + dlerror());
  const auto make = reinterpret_cast<MakeDdsBackend>(dlsym(opened, "orca_make_dds_backend"));
  if (make == nullptr) return fail(Code::unavailable, library + " is not the library of Orca's link dds");
  MadeDdsBackend made;
  make(options, made);
  return std::move(*made);
}

}  // namespace orca
