// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "orca/base/result.hpp"
#include "orca/component/manifest.hpp"
#include "orca/plugin/image.hpp"

namespace orca::plugin {

class LoadedPlugin;
class StandardStreams;

/// The trial of a plugin in a copy of the process, before it is loaded.
enum class Trial {
  now,
  done,  ///< Some process of this program has tried it, or this one is such a copy.
};

/// Tries out several plugins in one copy of the process, one after the other. load() does not try out again alone what has survived, so
/// twenty plugins need no twenty copies. It says nothing of a plugin that cannot be loaded or did not survive: load() does.
///
/// @thread  as PluginLibrary::load().
void try_together(const std::vector<std::string>& paths);

/// A plugin in memory, from load() until the object is destroyed. Everything made from its types must be
/// destroyed before. A plugin that stays in memory, or whose threads still run, is reported as pinned.
///
/// Thread contract: one thread.
class PluginLibrary {
 public:
  /// Checks a plugin's file, loads it and constructs its types in a copy of the process as a trial, and then
  /// loads it. A file that has passed is not checked again until it is changed.
  ///
  /// @thread  any; one call at a time.
  /// @errors  not_found if there is no such file; failed_precondition if others can write it
  ///          (orca/base/files/trusted_code.hpp); invalid_argument, with all errors and what to do, for a
  ///          file that cannot be loaded, that is not an Orca plugin, that was built for another ABI version
  ///          or other layouts of the objects, or not by the recipe (docs/adr/0004); internal or
  ///          deadline_exceeded if the copy of the process did not survive or come to an end.
  static Result<std::unique_ptr<PluginLibrary>> load(const std::string& path);

  /// Does the same with the image of a file. Messages name the file that it was copied from.
  static Result<std::unique_ptr<PluginLibrary>> load(PluginImage image, Trial trial = Trial::now);

  ~PluginLibrary();
  PluginLibrary(const PluginLibrary&) = delete;
  PluginLibrary& operator=(const PluginLibrary&) = delete;

  /// Returns the absolute path of the file that it was loaded or copied from.
  [[nodiscard]] const std::string& path() const { return path_; }
  /// Returns the name of its file in a process's memory map.
  [[nodiscard]] const std::string& mapped_name() const { return mapped_name_; }
  /// Returns the build id that the linker wrote into it, in hexadecimal digits; empty if there is none. It distinguishes this
  /// build of the code from any other.
  [[nodiscard]] const std::string& build_id() const { return build_id_; }
  [[nodiscard]] const Manifest& manifest() const { return *manifest_; }
  [[nodiscard]] std::vector<const TypeEntry*> types() const;
  /// Returns what it uses that must not be used in virtual time, each with its replacement.
  [[nodiscard]] const std::vector<std::string>& virtual_time_faults() const { return virtual_time_faults_; }
  /// Sends the reason to `sink` if the plugin stays in memory; without a sink it goes to the log.
  void on_pinned(std::function<void(const std::string& why)> sink) { on_pinned_ = std::move(sink); }
  /// Returns a type; null if the plugin holds no such type.
  [[nodiscard]] const TypeEntry* find(PluginKind kind, std::string_view type) const;

 private:
  struct Source;
  PluginLibrary(const Source& source, void* handle);
  static Result<std::unique_ptr<PluginLibrary>> open(const Source& source);
  std::string unload();
  void restore_streams() const;
  void tell_pinned(const std::string& why) const;

  std::optional<PluginImage> image_;  // its number is the name by which the dynamic linker knows it
  std::string path_;
  std::string mapped_name_;
  void* handle_;
  const Manifest* manifest_;
  std::unique_ptr<LoadedPlugin> entry_;
  std::unique_ptr<StandardStreams> streams_;  // as they were when it was loaded
  std::string build_id_;
  std::vector<std::string> virtual_time_faults_;
  std::function<void(const std::string&)> on_pinned_;
  bool may_start_threads_ = false;
};

/// Returns whether code of the file is still mapped into this process, even if the file itself has been
/// removed or exchanged meanwhile. This is the proof after unloading.
/// @param path  of a file, or PluginImage::mapped_name().
[[nodiscard]] bool is_mapped(const std::string& path);

}  // namespace orca::plugin
