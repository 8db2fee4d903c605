// SPDX-License-Identifier: LGPL-3.0-or-later
#include "load_error.hpp"

#include <dlfcn.h>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <filesystem>
#include <new>
#include <vector>

#include "elf_file.hpp"
#include "orca/base/text.hpp"

namespace orca::plugin {
namespace {

namespace fs = std::filesystem;

// Returns the folders of a list separated by ':', with "$ORIGIN" replaced.
std::vector<std::string> folders_of(std::string_view list, const std::string& origin) {
  std::vector<std::string> folders;
  while (!list.empty()) {
    std::string folder(list.substr(0, list.find(':')));
    list.remove_prefix(std::min(list.size(), folder.size() + 1));
    for (const std::string mark : {"${ORIGIN}", "$ORIGIN"})
      if (const auto at = folder.find(mark); at != std::string::npos) folder.replace(at, mark.size(), origin);
    if (!folder.empty()) folders.push_back(folder);
  }
  return folders;
}

// The libraries that a library needs, opened as the loader would open them, and the names of those missing.
class Needed {
 public:
  Needed(const ElfFile& library, const std::string& path) {
    const auto folders = folders_of(library.search_path(), fs::path(path).parent_path().string());
    for (const std::string_view name : library.needed()) open(std::string(name), folders);
  }
  ~Needed() {
    for (void* handle : handles_) dlclose(handle);
  }
  Needed(const Needed&) = delete;
  Needed& operator=(const Needed&) = delete;

  [[nodiscard]] const std::vector<std::string>& missing() const { return missing_; }
  /// Returns why one that is there cannot be used, in the words of the loader; empty if all can.
  [[nodiscard]] const std::string& unusable() const { return unusable_; }

  [[nodiscard]] bool provide(const ElfSymbol& symbol) const {
    if (find(RTLD_DEFAULT, symbol)) return true;
    for (void* handle : handles_)
      if (find(handle, symbol)) return true;
    return false;
  }

 private:
  void open(const std::string& name, const std::vector<std::string>& folders) {
    void* handle = nullptr;
    std::error_code unused;
    for (const std::string& folder : folders)
      if (handle == nullptr && fs::exists(folder + "/" + name, unused))
        handle = dlopen((folder + "/" + name).c_str(), RTLD_LAZY | RTLD_LOCAL);
    if (handle == nullptr) handle = dlopen(name.c_str(), RTLD_LAZY | RTLD_LOCAL);
    if (handle != nullptr) {
      handles_.push_back(handle);
      return;
    }
    // Others are there, but memory may be too small to map them.
    const char* const reason = dlerror();
    if (reason != nullptr &&
        std::string_view(reason).find("cannot open shared object file") == std::string_view::npos)
      unusable_ = reason;
    else
      missing_.push_back(name);
  }

  static bool find(void* handle, const ElfSymbol& symbol) {
    const std::string name(symbol.name);
    dlerror();
    const void* const found = symbol.version.empty()
                                  ? dlsym(handle, name.c_str())
                                  : dlvsym(handle, name.c_str(), std::string(symbol.version).c_str());
    return found != nullptr || dlerror() == nullptr;  // the value of a symbol may be null
  }

  std::vector<void*> handles_;
  std::vector<std::string> missing_;
  std::string unusable_;
};

// Sorted by name: the order of a symbol table is the compiler's, and an error must not change with it.
std::vector<std::string> unprovided_symbols(const ElfFile& library, const Needed& needed) {
  std::vector<std::string> names;
  for (const ElfSymbol& symbol : library.symbols()) {
    if (symbol.defined || symbol.weak || symbol.name.empty() || needed.provide(symbol)) continue;
    names.push_back(demangled(symbol.name));
    if (!symbol.version_of.empty())
      names.back() += " (expected in " + std::string(symbol.version_of) + ", version " +
                      std::string(symbol.version) + ")";
  }
  std::sort(names.begin(), names.end());
  return names;
}

}  // namespace

bool says_no_memory(std::string_view words) {
  // elf/dl-load.c, dl-map-segments.h, dl-object.c and dl-tls.c of glibc 2.36.
  constexpr std::array<std::string_view, 8> kWords{"failed to map segment",
                                                   "cannot map zero-fill pages",
                                                   "cannot change memory protections",
                                                   "Cannot allocate memory",
                                                   "cannot create shared object descriptor",
                                                   "cannot allocate",
                                                   "cannot create TLS data structures",
                                                   "out of memory"};
  return std::ranges::any_of(kWords, [&](std::string_view each) { return words.find(each) != words.npos; });
}

std::string explain_load_error(const ElfFile& library, const std::string& path, const std::string& words) {
  const Needed needed(library, path);
  if (!needed.missing().empty())
    return "it needs libraries that are not found: " + listed(needed.missing()) +
           "; install them, or build the plugin again where they are";
  if (says_no_memory(needed.unusable())) throw std::bad_alloc();
  if (!needed.unusable().empty()) return needed.unusable();
  const std::vector<std::string> symbols = unprovided_symbols(library, needed);
  if (symbols.empty()) return words;
  return "it uses " + listed(symbols) +
         ", which no library provides; link what it needs with orca_add_component(... LINK ...), or build it "
         "again with this Orca";
}

}  // namespace orca::plugin
