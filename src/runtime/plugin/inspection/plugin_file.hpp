// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "elf_file.hpp"
#include "object_types_of.hpp"
#include "orca/base/result.hpp"

namespace orca::plugin {

/// The description of a plugin from its file alone, before any of its code has run.
///
/// A value. Its bytes are not trusted, like those of an ElfFile.
class PluginFile {
 public:
  /// @errors  not_found, data_loss or invalid_argument if the file cannot be read, or is not a shared library
  ///          for this machine.
  static Result<PluginFile> read(const std::string& path);
  static Result<PluginFile> parse(std::vector<std::byte> bytes);

  /// Returns every reason not to load the plugin: no manifest, another ABI version, object types of another
  /// layout, or a build that could not be unloaded. Empty if none was found.
  [[nodiscard]] std::vector<std::string> faults(const KnownType& known) const;

  /// Returns every symbol, instruction and path that the plugin uses but must not use in virtual time, with its
  /// replacement. If the
  /// plugin declares that it needs the steady clock, returns its reasons instead.
  [[nodiscard]] std::vector<std::string> virtual_time_faults() const;

  /// Returns whether the plugin can start threads by itself.
  [[nodiscard]] bool may_start_threads() const;

  [[nodiscard]] const ElfFile& elf() const { return elf_; }

 private:
  explicit PluginFile(ElfFile elf) : elf_(std::move(elf)) {}

  void check_manifest(std::vector<std::string>& faults) const;
  void check_recipe(std::vector<std::string>& faults) const;
  void check_layouts(std::vector<std::string>& faults) const;
  [[nodiscard]] const ElfSymbol* manifest() const;
  /// Returns what the plugin's bytes show of clocks and random numbers, apart from symbols.
  [[nodiscard]] std::vector<std::string_view> telltales() const;
  /// Returns the texts of the notes that start with `mark`, without the mark.
  [[nodiscard]] std::vector<std::string> notes(std::string_view mark) const;

  ElfFile elf_;
};

}  // namespace orca::plugin
