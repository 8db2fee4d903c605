// SPDX-License-Identifier: LGPL-3.0-or-later
#include "orca/plugin/object_library.hpp"

#include <dlfcn.h>
#include <sys/stat.h>

#include <algorithm>
#include <filesystem>
#include <map>
#include <optional>
#include <tuple>
#include <utility>

#include "inspection/object_types_of.hpp"
#include "inspection/plugin_file.hpp"
#include "opening.hpp"
#include "orca/base/layout.hpp"
#include "orca/base/log.hpp"
#include "orca/base/mutex.hpp"
#include "orca/base/text.hpp"
#include "orca/idl/object_type.hpp"
#include "orca/plugin/trial.hpp"

namespace orca::plugin {
namespace {

namespace fs = std::filesystem;

// A file as it was at one moment.
using FileState = std::tuple<std::string, dev_t, ino_t, off_t, time_t, long>;

std::optional<FileState> state_of(const std::string& file) {
  struct stat status {};
  if (stat(file.c_str(), &status) != 0) return std::nullopt;
  return FileState{file,           status.st_dev,         status.st_ino,
                   status.st_size, status.st_mtim.tv_sec, status.st_mtim.tv_nsec};
}

std::string file_name(const std::string& file) { return fs::path(file).filename().string(); }

// The libraries that are in memory, and what came of each file that was asked for.
class ObjectLibraries {
 public:
  Status load(const std::string& file, Trial trial) {
    const MutexLock lock(mutex_);
    const std::optional<FileState> state = state_of(file);
    if (!state) return fail(Code::not_found, "there is no such library of object types", file);
    if (const auto known = outcomes_.find(*state); known != outcomes_.end()) return known->second;
    Status outcome = load_new(file, trial);
    if (outcome.ok() || outcome.error().code != Code::unavailable) outcomes_.emplace(*state, outcome);
    return outcome;
  }

  /// Returns whether a message about a file is new, and takes note of it.
  bool is_news(const std::string& text) {
    const MutexLock lock(mutex_);
    if (std::ranges::find(told_, text) != told_.end()) return false;
    told_.push_back(text);
    return true;
  }

  [[nodiscard]] std::vector<ObjectLibrary> all() {
    const MutexLock lock(mutex_);
    return loaded_;
  }

 private:
  Status load_new(const std::string& file, Trial trial) ORCA_REQUIRES(mutex_) {
    const Result<PluginFile> read = PluginFile::read(file);
    if (!read) return read.error();
    const ElfFile& elf = read->elf();
    const auto same_name = [&](const ObjectLibrary& one) { return file_name(one.file) == file_name(file); };
    if (const auto here = std::ranges::find_if(loaded_, same_name); here != loaded_.end())
      return compare(elf, file, here->file);
    if (is_in_memory(file)) return take_over(elf, file);
    std::vector<std::string> faults = object_library_faults(elf, known_type);
    for (const std::string_view layout : layouts_in(elf))
      if (find_object_type(name_in(layout)) != nullptr) faults.push_back(clash(std::string(name_in(layout))));
    if (!faults.empty()) return fail(Code::invalid_argument, joined(faults, "; it "), file);
    if (Status survived = try_out(file, trial); !survived.ok()) return survived;
    return open(elf, file);
  }

  // Compares a library with one of the same name, which is in memory and cannot be exchanged: plugins that need the one get the other.
  static Status compare(const ElfFile& elf, const std::string& file, const std::string& here) {
    std::vector<std::string> faults;
    for (const std::string_view layout : layouts_in(elf)) {
      const std::string name(name_in(layout));
      const TypeId known = known_type(name);
      if (known.layout == layout) continue;
      faults.push_back(
          "has " + (known.name.empty()
                        ? "the object type " + name + ", which that one does not have"
                        : "another layout of the object type " + name + ": " +
                              layout_difference(layout, known.layout, {"in this library", "in that one"})));
    }
    if (faults.empty()) return ok();
    return fail(Code::already_exists,
                "a library of this name is in memory, " + here + ", and this one " + joined(faults, " and ") +
                    "; start the system again if it was built anew, or give one of the two another name",
                file);
  }

  // A program may be linked with the library.
  static bool is_in_memory(const std::string& file) {
    void* const handle = dlopen(file_name(file).c_str(), RTLD_NOW | RTLD_NOLOAD);
    if (handle != nullptr) dlclose(handle);
    return handle != nullptr;
  }

  Status take_over(const ElfFile& elf, const std::string& file) ORCA_REQUIRES(mutex_) {
    if (Status same = compare(elf, file, "which this program is linked with"); !same.ok()) return same;
    note(elf, file);
    return ok();
  }

  void note(const ElfFile& elf, const std::string& file) ORCA_REQUIRES(mutex_) {
    ObjectLibrary library{file, {}};
    for (const std::string_view layout : layouts_in(elf)) library.types.emplace_back(name_in(layout));
    loaded_.push_back(std::move(library));
  }

  std::string clash(const std::string& type) const ORCA_REQUIRES(mutex_) {
    std::string holder = "Orca itself";
    for (const ObjectLibrary& one : loaded_)
      if (std::ranges::find(one.types, type) != one.types.end()) holder = one.file;
    return "has the object type " + type + ", which " + holder +
           " has, too; give one of the two another name, or its IDL another module";
  }

  static Status try_out(const std::string& file, Trial trial) {
    if (trial == Trial::done) return ok();
    const auto attempt = [&](const std::function<void(const std::string&)>& step) {
      step("its static initialisation");
      (void)try_to_open(file.c_str());
    };
    const Status survived = survives_trial(attempt, kTrialLimit);
    if (survived.ok()) return ok();
    return fail(survived.error().code, survived.error().message + ", when it was tried out", file);
  }

  Status open(const ElfFile& elf, const std::string& file) ORCA_REQUIRES(mutex_) {
    if (const Result<void*> handle = open_library(file, file, RTLD_NODELETE); !handle) return handle.error();
    for (const std::string_view layout : layouts_in(elf))
      if (known_type(std::string(name_in(layout))).layout != layout)
        return fail(Code::invalid_argument,
                    "does not make its object type " + std::string(name_in(layout)) +
                        " known; build it with orca_generate_idl()",
                    file);
    note(elf, file);
    return ok();
  }

  Mutex mutex_;
  std::vector<ObjectLibrary> loaded_ ORCA_GUARDED_BY(mutex_);
  std::map<FileState, Status> outcomes_ ORCA_GUARDED_BY(mutex_);
  std::vector<std::string> told_ ORCA_GUARDED_BY(mutex_);
};

// Never destroyed: threads may ask while the program ends.
ObjectLibraries& libraries() {
  static auto& all = *new ObjectLibraries;
  return all;
}

}  // namespace

Status load_object_library(const std::string& file, Trial trial) {
  return libraries().load(fs::weakly_canonical(fs::absolute(file)).string(), trial);
}

void load_object_libraries(const PluginIndex& index) {
  for (const std::string& file : index.object_libraries()) {
    const Status loaded = load_object_library(file);
    if (!loaded.ok() && libraries().is_news(loaded.error().text()))
      log::warning(file_name(file), loaded.error().text());
  }
}

std::vector<ObjectLibrary> object_libraries() { return libraries().all(); }

}  // namespace orca::plugin
