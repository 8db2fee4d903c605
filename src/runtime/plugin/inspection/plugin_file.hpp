// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

#include "elf_file.hpp"
#include "orca/base/contract.hpp"
#include "orca/base/result.hpp"

namespace orca::plugin {

/// What can be said of a plugin from its file alone, before any of its code has run.
///
/// A value. The bytes are not trusted, as ElfFile's.
class PluginFile {
 public:
  /// The type of that name as this process knows it; a TypeId without name if there is none.
  using KnownType = std::function<TypeId(const std::string& name)>;

  /// @errors  not_found or invalid_argument if the file cannot be read or is no shared library for this
  /// machine.
  static Result<PluginFile> read(const std::string& path);
  static Result<PluginFile> parse(std::vector<std::byte> bytes);

  /// Every reason not to load it: no manifest, another ABI version, object types of another layout, a build
  /// that could not be unloaded. Empty: none was found.
  [[nodiscard]] std::vector<std::string> faults(const KnownType& known) const;

  /// What it uses that has no place in virtual time, each with what to use instead; or that it says so
  /// itself.
  [[nodiscard]] std::vector<std::string> virtual_time_faults() const;

  /// Whether it can start threads by itself.
  [[nodiscard]] bool may_start_threads() const;

  [[nodiscard]] const ElfFile& elf() const { return elf_; }

 private:
  explicit PluginFile(ElfFile elf) : elf_(std::move(elf)) {}

  void check_manifest(std::vector<std::string>& faults) const;
  void check_recipe(std::vector<std::string>& faults) const;
  void check_layouts(std::vector<std::string>& faults) const;
  void check_types(const KnownType& known, std::vector<std::string>& faults) const;
  [[nodiscard]] std::string layout_of(const std::string& type) const;
  [[nodiscard]] const ElfSymbol* manifest() const;
  /// The texts of the notes that start with `mark`, without it.
  [[nodiscard]] std::vector<std::string> notes(std::string_view mark) const;

  ElfFile elf_;
};

/// The types that liborca_idl.so of this process has.
[[nodiscard]] TypeId known_type(const std::string& name);

}  // namespace orca::plugin
