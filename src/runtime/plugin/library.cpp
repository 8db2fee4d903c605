// SPDX-License-Identifier: LGPL-3.0-or-later
#include "orca/plugin/library.hpp"

#include <cxxabi.h>
#include <dlfcn.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <utility>

namespace orca {
namespace {

std::string demangled(const std::string& symbol) {
  int status = 0;
  char* const text = abi::__cxa_demangle(symbol.c_str(), nullptr, nullptr, &status);
  const std::string result = status == 0 ? text : symbol;
  std::free(text);
  return result;
}

// The loader's own words, with a C++ symbol made readable.
std::string explain_load_error(const std::string& text) {
  const std::string mark = "undefined symbol: ";
  const auto at = text.find(mark);
  if (at == std::string::npos) return text;
  const std::string rest = text.substr(at + mark.size());
  const std::string symbol = rest.substr(0, rest.find_first_of(",\t "));
  return "it uses " + demangled(symbol) +
         ", which no library provides; link what it needs with orca_add_component(... LINK ...)";
}

Error not_a_plugin(const std::string& path) {
  return fail(Code::invalid_argument,
              "is not an Orca plugin: it exports no orca_plugin_manifest; build it with orca_add_component()",
              path);
}

Status check_manifest(const Manifest& manifest, const std::string& path) {
  if (manifest.abi_version == kAbiVersion && manifest.size == sizeof(Manifest)) return ok();
  return fail(Code::invalid_argument,
              "was built for plugin ABI " + std::to_string(manifest.abi_version) + " (manifest of " +
                  std::to_string(manifest.size) + " bytes), but this is ABI " + std::to_string(kAbiVersion) +
                  " (" + std::to_string(sizeof(Manifest)) + " bytes); build it again",
              path);
}

}  // namespace

Result<std::unique_ptr<PluginLibrary>> PluginLibrary::load(const std::string& path) {
  std::error_code unused;
  if (!std::filesystem::is_regular_file(path, unused))
    return fail(Code::not_found, "there is no such plugin", path);
  // Absolute: a name without a slash would be searched where shared libraries are.
  const std::string file = std::filesystem::absolute(path).string();
  void* const handle = dlopen(file.c_str(), RTLD_NOW | RTLD_LOCAL);
  if (handle == nullptr)
    return fail(Code::invalid_argument, "cannot be loaded: " + explain_load_error(dlerror()), path);
  const auto* const manifest = static_cast<const Manifest*>(dlsym(handle, "orca_plugin_manifest"));
  const Status good = manifest != nullptr ? check_manifest(*manifest, path) : Status(not_a_plugin(path));
  if (!good.ok()) {
    dlclose(handle);
    return good.error();
  }
  return std::unique_ptr<PluginLibrary>(new PluginLibrary(file, handle, manifest));
}

PluginLibrary::PluginLibrary(std::string path, void* handle, const Manifest* manifest)
    : path_(std::move(path)), handle_(handle), manifest_(manifest) {}

PluginLibrary::~PluginLibrary() { dlclose(handle_); }

std::vector<const TypeEntry*> PluginLibrary::types() const {
  return {manifest_->first_type, manifest_->end_of_types};
}

const TypeEntry* PluginLibrary::find(PluginKind kind, std::string_view type) const {
  for (const TypeEntry* entry : types())
    if (entry->kind == kind && type == entry->type) return entry;
  return nullptr;
}

bool is_mapped(const std::string& path) {
  const std::string real = std::filesystem::weakly_canonical(path).string();
  std::ifstream maps("/proc/self/maps");
  for (std::string line; std::getline(maps, line);) {
    const auto start = line.find('/');
    if (start == std::string::npos) continue;
    const std::string file = line.substr(start);
    if (file == real || file == real + " (deleted)") return true;
  }
  return false;
}

}  // namespace orca
