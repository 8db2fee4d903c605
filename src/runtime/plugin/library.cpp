// SPDX-License-Identifier: LGPL-3.0-or-later
#include "orca/plugin/library.hpp"

#include <dlfcn.h>
#include <sys/stat.h>

#include <filesystem>
#include <fstream>
#include <map>
#include <mutex>
#include <new>
#include <optional>
#include <tuple>
#include <utility>
#include <vector>

#include "inspection/code_identity.hpp"
#include "inspection/plugin_file.hpp"
#include "inspection/plugin_threads.hpp"
#include "inspection/ways_in.hpp"
#include "loaded_plugins.hpp"
#include "opening.hpp"
#include "orca/base/activity.hpp"
#include "orca/base/exhaustion.hpp"
#include "orca/base/files/trusted_code.hpp"
#include "orca/base/log.hpp"
#include "orca/base/text.hpp"
#include "orca/plugin/code_limit.hpp"
#include "orca/plugin/describe.hpp"
#include "orca/plugin/object_library.hpp"
#include "orca/plugin/standard_streams.hpp"
#include "orca/plugin/trial.hpp"

namespace orca::plugin {
namespace {

namespace fs = std::filesystem;

constexpr int kTrialRounds = 3;  // what goes well once need not go well again

Error refuse(const std::string& path, const std::string& what) {
  return fail(Code::invalid_argument, what, path);
}

const Manifest* manifest_of(void* handle) {
  return static_cast<const Manifest*>(dlsym(handle, "orca_plugin_manifest"));
}

// Does everything that loading and describing the plugin would do, for a trial.
void load_and_describe(const std::string& path, const std::function<void(const std::string&)>& step) {
  step("its static initialisation");
  void* const handle = try_to_open(path.c_str());
  if (handle == nullptr) return;
  const Manifest& manifest = *manifest_of(handle);
  const std::size_t count = static_cast<std::size_t>(manifest.end_of_types - manifest.first_type);
  for (std::size_t i = 0; i < kTrialRounds * count; ++i) {
    const TypeEntry* const* const type = manifest.first_type + i % count;
    step("the constructor or destructor of " + std::string((*type)->type));
    if ((*type)->kind == PluginKind::component) {
      (void)describe_component(**type, path, nullptr);
    } else {
      (void)describe_hardware(**type, path, (*type)->type);
    }
  }
  step("its static destruction");
  const LoadedPlugin extent(path, &manifest);
  StandardStreams::at_start().restore();
  if (!threads_may_run_in(extent.start(), extent.end()) && ways_into(extent.start(), extent.end()).empty())
    dlclose(handle);  // as unload() does
}

// Loads the libraries beside a plugin whose object types it uses.
Status load_needed_types(const ElfFile& elf, const std::string& path, Trial trial) {
  for (const std::string_view name : elf.needed()) {
    const fs::path file = fs::path(path).parent_path() / name;
    std::error_code unused;
    if (!fs::exists(file, unused) || !fs::exists(fs::path(file).replace_extension(".types"), unused))
      continue;
    if (const Status loaded = load_object_library(file.string(), trial); !loaded.ok())
      return fail(loaded.error().code,
                  "cannot be loaded, because of the object types that it uses: " + loaded.error().text(),
                  path);
  }
  return ok();
}

// The facts about a file that has passed its checks and its trial.
struct Judgement {
  std::vector<std::string> virtual_time_faults;
  bool may_start_threads = false;
  CodeIdentity identity;
};

// Judges what can be seen without running its code.
// @param trial  of the libraries with object types that it uses, which are loaded.
Result<Judgement> inspect(const std::string& path, const std::string& file, Trial trial) {
  const Result<PluginFile> read = PluginFile::read(file);
  if (!read) return fail(read.error().code, read.error().message, path);
  if (Status types = load_needed_types(read->elf(), path, trial); !types.ok()) return types.error();
  if (const auto faults = read->faults(known_type); !faults.empty())
    return refuse(path, joined(faults, "; it "));
  return Judgement{read->virtual_time_faults(), read->may_start_threads(), identity_of(read->elf())};
}

Result<Judgement> judge(const std::string& path, const std::string& file, Trial trial) {
  Result<Judgement> judged = inspect(path, file, trial);
  if (!judged || trial == Trial::done) return judged;
  const auto attempt = [&](const auto& step) { load_and_describe(file, step); };
  if (const Status survived = survives_trial(attempt, kTrialLimit); !survived.ok())
    return fail(survived.error().code, survived.error().message + ", when it was tried out", path);
  return judged;
}

// A file that has not been written or exchanged since.
using FileIdentity = std::tuple<std::string, dev_t, ino_t, off_t, time_t, long>;

std::optional<FileIdentity> identity_of_file(const std::string& file) {
  struct stat status {};
  if (stat(file.c_str(), &status) != 0) return std::nullopt;
  return FileIdentity{file,           status.st_dev,         status.st_ino,
                      status.st_size, status.st_mtim.tv_sec, status.st_mtim.tv_nsec};
}

using Judgements = std::map<FileIdentity, Judgement>;

// Those of all files that have survived their trial.
Judgements& known_judgements() {
  static Judgements known;
  return known;
}

// Returns the same judgement for the same file until it is written or exchanged. The file may be asked for
// again while a robot drives, when there is no time for a trial.
Result<Judgement> judge_once(const std::string& path, const std::string& file) {
  Judgements& known = known_judgements();
  const auto identity = identity_of_file(file);
  if (!identity) return fail(Code::not_found, "there is no such plugin", path);
  if (const auto found = known.find(*identity); found != known.end()) return found->second;
  Result<Judgement> judged = judge(path, file, Trial::now);
  if (!judged && judged.error().message.starts_with(kNoMemoryText)) throw std::bad_alloc();
  if (judged) known.emplace(*identity, *judged);
  return judged;
}

// The remains of a plugin that stays in memory for ever.
struct Remains {
  std::unique_ptr<LoadedPlugin> entry;
  std::optional<PluginImage> image;
};

// Keeps a plugin known for ever. The dynamic linker knows it by the name of its image, and would return it to whoever opens
// another image of that name, so the image keeps its number for ever, too.
void keep_known(Remains remains) {
  static std::mutex mutex;
  static auto& kept = *new std::vector<Remains>;
  const std::lock_guard lock(mutex);
  kept.push_back(std::move(remains));
}

}  // namespace

void try_together(const std::vector<std::string>& paths) {
  Judgements untried;
  for (const std::string& path : paths) {
    const std::string file = fs::absolute(path).string();
    const auto identity = identity_of_file(file);
    if (!identity || known_judgements().contains(*identity) || !check_trusted_code(file).ok()) continue;
    if (const Result<Judgement> judged = inspect(path, file, Trial::now)) untried.emplace(*identity, *judged);
  }
  if (untried.size() < 2) return;
  const auto attempt = [&](const auto& step) {
    for (const auto& [identity, judged] : untried) load_and_describe(std::get<0>(identity), step);
  };
  if (survives_trial(attempt, kTrialLimit).ok()) known_judgements().merge(untried);
}

// The file that the dynamic linker is to open, after it was judged.
struct PluginLibrary::Source {
  std::string path;         // for people
  std::string file;         // to open
  std::string mapped_name;  // in the memory map
  Judgement judged;
};

Result<std::unique_ptr<PluginLibrary>> PluginLibrary::load(const std::string& path) {
  std::error_code unused;
  if (!fs::is_regular_file(path, unused)) return fail(Code::not_found, "there is no such plugin", path);
  // Absolute, because a name without a slash would be searched in the folders of shared libraries.
  const std::string file = fs::absolute(path).string();
  if (const Status trusted = check_trusted_code(file); !trusted.ok())
    return fail(trusted.error().code, "is not loaded: " + trusted.error().message, path);
  Result<Judgement> judged = judge_once(path, file);
  if (!judged) return judged.error();
  Result<std::unique_ptr<PluginLibrary>> library = open({file, file, file, std::move(judged).value()});
  if (library || library.error().code != Code::already_exists) return library;
  // The file was rewritten, and its former content is in memory for some reason.
  Result<PluginImage> image = PluginImage::copy(file);
  if (!image) return image.error();
  return load(std::move(image).value());
}

Result<std::unique_ptr<PluginLibrary>> PluginLibrary::load(PluginImage image, Trial trial) {
  Result<Judgement> judged = judge(image.origin(), image.path(), trial);
  if (!judged) return judged.error();
  Result<std::unique_ptr<PluginLibrary>> library =
      open({image.origin(), image.path(), image.mapped_name(), std::move(judged).value()});
  if (library) (*library)->image_.emplace(std::move(image));
  return library;
}

Result<std::unique_ptr<PluginLibrary>> PluginLibrary::open(const Source& source) {
  const Result<void*> handle = open_library(source.path, source.file);
  if (!handle) return handle.error();
  if (identity_in_memory(*handle) != source.judged.identity) {
    dlclose(*handle);
    return fail(
        Code::already_exists,
        "cannot be loaded: the dynamic linker returned another library, which is in memory under the same "
        "name; start the process again",
        source.path);
  }
  std::unique_ptr<PluginLibrary> library(new PluginLibrary(source, *handle));
  for (const TypeEntry* type : library->types())
    if (library->find(type->kind, type->type) != type)  // that is the first of this name
      return refuse(source.path, "holds two classes with the type " + in_quotes(type->type) +
                                     "; give one of them another name, else nobody knows which one runs");
  return library;
}

PluginLibrary::PluginLibrary(const Source& source, void* handle)
    : path_(source.path),
      mapped_name_(source.mapped_name),
      handle_(handle),
      manifest_(manifest_of(handle)),
      entry_(std::make_unique<LoadedPlugin>(path_, manifest_)),
      streams_(std::make_unique<StandardStreams>()),
      build_id_(source.judged.identity.build_id),
      virtual_time_faults_(source.judged.virtual_time_faults),
      may_start_threads_(source.judged.may_start_threads) {}

PluginLibrary::~PluginLibrary() {
  const std::string why = unload();
  if (why.empty()) return;
  keep_known(
      {entry_ ? std::move(entry_) : std::make_unique<LoadedPlugin>(path_, manifest_), std::move(image_)});
  tell_pinned(why);
}

// Returns why the plugin stays in memory; empty if it does not, or if somebody else uses it, too.
std::string PluginLibrary::unload() {
  if (may_start_threads_ && threads_may_run_in(entry_->start(), entry_->end()))
    return "a thread runs in it, and would crash without it, so it stays in memory. A component must have "
           "ended its "
           "threads when it is destroyed";
  if (const std::vector<std::string> ways = ways_into(entry_->start(), entry_->end()); !ways.empty())
    return "the process would crash without it, so it stays in memory: it is entered by " +
           joined(ways, ", ") + ". A component must put back what it has set when it is destroyed";
  restore_streams();
  entry_.reset();
  {
    const CodeLimit limit;
    const Activity activity(path_.c_str(), Hook::unload, manifest_);
    dlclose(handle_);
  }
  const bool loaded_elsewhere = plugin_at(manifest_) != nullptr;
  if (loaded_elsewhere || !is_mapped(mapped_name_)) return {};
  return "it is still in memory after it was unloaded, and so are its variables";
}

// Those that they had when it was loaded may be another plugin's, which has gone since, so those of the start come back.
void PluginLibrary::restore_streams() const {
  const std::vector<std::string> changed = streams_->changes();
  if (changed.empty()) return;
  StandardStreams::at_start().restore();
  log::warning(fs::path(path_).filename().string(),
               "it, or another plugin, has changed " + joined(changed, " and ") +
                   ", which all share; it is put back, because the code that it leads into is unloaded");
}

void PluginLibrary::tell_pinned(const std::string& why) const {
  if (on_pinned_) return on_pinned_(why);
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
    // Whoever looks up names of functions, as a sanitizer does for its reports, maps files to read them.
    const bool is_code = line.find(" r-xp ") != std::string::npos;
    const auto start = is_code ? line.find('/') : std::string::npos;
    if (start == std::string::npos) continue;
    const std::string file = line.substr(start);
    if (file == real || file == real + " (deleted)") return true;
  }
  return false;
}

}  // namespace orca::plugin
