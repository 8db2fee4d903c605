// SPDX-License-Identifier: LGPL-3.0-or-later
#include "opening.hpp"

#include <dlfcn.h>

#include <cerrno>
#include <filesystem>
#include <new>
#include <vector>

#include "inspection/load_error.hpp"
#include "inspection/plugin_file.hpp"
#include "orca/base/exhaustion.hpp"
#include "orca/base/log.hpp"
#include "orca/base/text.hpp"
#include "orca/plugin/code_limit.hpp"
#include "shared_settings.hpp"

namespace orca::plugin {
namespace {

Error cannot_load(const std::string& path, const std::string& file, const std::string& words) {
  if (says_no_memory(words)) throw std::bad_alloc();
  const Result<PluginFile> read = PluginFile::read(file);
  return fail(Code::invalid_argument,
              "cannot be loaded: " + (read ? explain_load_error(read->elf(), file, words) : words), path);
}

}  // namespace

// dlopen() is declared not to throw, so the compiler may leave out what would stop the exception here. It would then reach some
// handler far out, and the library would seem to have survived.
void* try_to_open(const char* file) noexcept {
  void* (*volatile const open)(const char*, int) = dlopen;
  return open(file, RTLD_NOW | RTLD_LOCAL);
}

Result<void*> open_library(const std::string& path, const std::string& file, int flags) {
  const SharedSettings settings;
  const CodeLimit limit;
  errno = 0;
  void* const handle = dlopen(file.c_str(), RTLD_NOW | RTLD_LOCAL | flags);
  const int reason = errno;
  if (const std::vector<std::string> changed = settings.put_back(); !changed.empty())
    log::warning(std::filesystem::path(path).filename().string(),
                 "its static initialisation has changed " + joined(changed, " and ") +
                     ", which all share; it is put back. Let configure() ask for what the plugin needs");
  if (handle != nullptr) return handle;
  throw_if_exhausted(reason);
  const char* const words = dlerror();
  return cannot_load(path, file, words == nullptr ? "no reason is given" : words);
}

}  // namespace orca::plugin
