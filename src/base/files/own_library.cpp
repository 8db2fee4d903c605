// SPDX-License-Identifier: LGPL-3.0-or-later
#include "orca/base/files/own_library.hpp"

#include <dlfcn.h>

#include <filesystem>
#include <vector>

namespace orca {

namespace fs = std::filesystem;

namespace {

// Returns the folder that has the program in bin/.
fs::path own_prefix() {
  std::error_code ignored;
  return fs::read_symlink("/proc/self/exe", ignored).parent_path().parent_path();
}

// Returns the path of a library that lies beside this one. The loader would find it by name, but not under the sanitizers, which stand
// between the caller and the loader.
std::string beside_own_library(const std::string& name) {
  Dl_info own{};
  if (dladdr(reinterpret_cast<const void*>(&own_plugin_folder), &own) == 0) return name;
  return (fs::path(own.dli_fname).parent_path() / name).string();
}

}  // namespace

Result<void*> late_function(const std::string& library, const char* name) {
  void* const opened = dlopen(beside_own_library(library).c_str(), RTLD_NOW | RTLD_LOCAL | RTLD_NODELETE);
  void* const function = opened != nullptr ? dlsym(opened, name) : nullptr;
  if (function != nullptr) return function;
  const char* const error = dlerror();
  return fail(Code::unavailable,
              library + " cannot be used: " + (error != nullptr ? error : "it is damaged"));
}

std::string own_plugin_folder() {
  std::error_code ignored;
  const fs::path installed = own_prefix() / "lib/orca/plugins";
  return (fs::is_directory(installed, ignored) ? installed : own_prefix() / "plugins").string();
}

std::string own_file(const std::string& name) { return (own_prefix() / "share/orca" / name).string(); }

std::string or_own_file(const std::string& name) {
  std::error_code ignored;
  if (name.empty() || fs::path(name).is_absolute() || fs::exists(name, ignored)) return name;
  const std::string own = own_file(name);
  return fs::is_regular_file(own, ignored) ? own : name;
}

std::string hint_at_own_file(const std::string& path) {
  std::error_code ignored;
  const fs::path normal = fs::path(path).lexically_normal();
  const std::vector<fs::path> names(normal.begin(), normal.end());
  for (std::size_t from = 0; from + 1 < names.size(); ++from) {
    fs::path end;
    for (std::size_t i = from; i < names.size(); ++i) end /= names[i];
    if (end.is_absolute() || names[from] == "..") continue;
    const std::string own = own_file(end.string());
    if (fs::is_regular_file(own, ignored)) return "; Orca's own is " + own;
  }
  return {};
}

}  // namespace orca
