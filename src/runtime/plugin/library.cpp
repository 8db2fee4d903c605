// SPDX-License-Identifier: LGPL-3.0-or-later
#include "orca/plugin/library.hpp"

#include <dlfcn.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <utility>

#include "load_error.hpp"
#include "loaded_plugins.hpp"
#include "orca/base/log.hpp"
#include "orca/plugin/describe.hpp"
#include "plugin_file.hpp"
#include "trial.hpp"

namespace orca {
namespace {

namespace fs = std::filesystem;

constexpr Duration kTrialLimit = 5s;

Error refuse(const std::string& path, const std::string& what) {
  return fail(Code::invalid_argument, what, path);
}

std::string joined(const std::vector<std::string>& faults) {
  std::string all;
  for (const std::string& fault : faults) all += (all.empty() ? "" : "; it ") + fault;
  return all;
}

const Manifest* manifest_of(void* handle) {
  return static_cast<const Manifest*>(dlsym(handle, "orca_plugin_manifest"));
}

// All that loading and describing the plugin would do, for a trial.
void load_and_describe(const std::string& path, const std::function<void(const std::string&)>& step) {
  step("its static initialisation");
  void* const handle = dlopen(path.c_str(), RTLD_NOW | RTLD_LOCAL);
  if (handle == nullptr) return;
  const Manifest& manifest = *manifest_of(handle);
  for (const TypeEntry* const* type = manifest.first_type; type != manifest.end_of_types; ++type) {
    step("the constructor or destructor of " + std::string((*type)->type));
    if ((*type)->kind == PluginKind::component) {
      (void)describe_component(**type, path, nullptr);
    } else {
      (void)describe_hardware(**type, path, (*type)->type);
    }
  }
  step("its static destruction");
  dlclose(handle);
}

std::size_t thread_count() {
  std::error_code unused;
  const fs::directory_iterator tasks("/proc/self/task", unused);
  return static_cast<std::size_t>(std::distance(begin(tasks), end(tasks)));
}

// How many threads there are more than there were. A thread that has been joined can still be seen for a
// moment.
std::size_t more_threads_than(std::size_t before) {
  constexpr int kPatienceMs = 200;
  for (int i = 0; i < kPatienceMs && thread_count() > before; ++i) usleep(1000);
  const std::size_t now = thread_count();
  return now > before ? now - before : 0;
}

}  // namespace

Result<std::unique_ptr<PluginLibrary>> PluginLibrary::load(const std::string& path) {
  std::error_code unused;
  if (!fs::is_regular_file(path, unused)) return fail(Code::not_found, "there is no such plugin", path);
  // Absolute: a name without a slash would be searched where shared libraries are.
  const std::string file = fs::absolute(path).string();
  const Result<PluginFile> read = PluginFile::read(path);
  if (!read) return read.error();
  if (const auto faults = read->faults(known_type); !faults.empty()) return refuse(path, joined(faults));
  const auto attempt = [&](const auto& step) { load_and_describe(file, step); };
  if (const Status survived = survives_trial(attempt, kTrialLimit); !survived.ok())
    return fail(survived.error().code, survived.error().message + ", when it was tried out", path);
  const std::size_t threads = thread_count();
  void* const handle = dlopen(file.c_str(), RTLD_NOW | RTLD_LOCAL);
  if (handle == nullptr)
    return refuse(path, "cannot be loaded: " + explain_load_error(read->elf(), file, dlerror()));
  auto library = std::unique_ptr<PluginLibrary>(new PluginLibrary(file, handle, manifest_of(handle)));
  library->virtual_time_faults_ = read->virtual_time_faults();
  if (read->may_start_threads()) library->threads_before_ = threads;
  return library;
}

PluginLibrary::PluginLibrary(std::string path, void* handle, const Manifest* manifest)
    : path_(std::move(path)),
      handle_(handle),
      manifest_(manifest),
      entry_(std::make_unique<LoadedPlugin>(path_, manifest)) {}

PluginLibrary::~PluginLibrary() {
  if (const std::size_t left = threads_before_ ? more_threads_than(*threads_before_) : 0; left > 0) {
    entry_.release();  // stays known for ever, as the plugin does
    tell_pinned("it can start threads, and " + std::to_string(left) +
                " more than before it was loaded are running; it stays in memory, because they would crash "
                "without it. A component must have ended its threads when it is destroyed");
    return;
  }
  entry_.reset();
  dlclose(handle_);
  const bool loaded_elsewhere = plugin_at(manifest_) != nullptr;
  if (!loaded_elsewhere && is_mapped(path_))
    tell_pinned("it is still in memory after it was unloaded, and so are its variables");
}

void PluginLibrary::tell_pinned(const std::string& why) const {
  log::error(fs::path(path_).filename().string(), "alarm PLUGIN_PINNED: " + why);
}

std::vector<const TypeEntry*> PluginLibrary::types() const {
  return {manifest_->first_type, manifest_->end_of_types};
}

const TypeEntry* PluginLibrary::find(PluginKind kind, std::string_view type) const {
  for (const TypeEntry* entry : types())
    if (entry->kind == kind && type == entry->type) return entry;
  return nullptr;
}

bool is_mapped(const std::string& path) {
  const std::string real = fs::weakly_canonical(path).string();
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
