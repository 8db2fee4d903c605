// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <elf.h>

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "orca/base/result.hpp"

namespace orca::plugin {

/// A symbol that a shared library offers to others, or needs from them.
struct ElfSymbol {
  std::string_view name;
  bool defined = false;
  bool weak = false;
  bool unique = false;          ///< STB_GNU_UNIQUE: one for the whole process; pins its library in memory.
  std::uint64_t address = 0;    ///< In the library's own address space; defined symbols only.
  std::string_view version;     ///< Version needed; empty: any.
  std::string_view version_of;  ///< File name of the library that the version belongs to.
};

/// The description of a shared library in its own file, as the loader reads it. No code of the library runs.
///
/// The bytes are not trusted: any bytes give an error, or a description that stays within them. The object is
/// a value that owns the bytes, and its views point into them.
/// @source  System V ABI, chapters 4 and 5; GNU hash and version tables as in glibc's <elf.h> and
///          elf/dl-lookup.c.
class ElfFile {
 public:
  using Bytes = std::span<const std::byte>;

  /// @errors  invalid_argument if this is not a complete 64-bit shared library for this machine.
  static Result<ElfFile> parse(std::vector<std::byte> bytes);

  ElfFile(ElfFile&&) = default;
  ElfFile& operator=(ElfFile&&) = default;

  [[nodiscard]] const std::vector<ElfSymbol>& symbols() const { return symbols_; }
  /// Returns the file names of the libraries that this one needs.
  [[nodiscard]] const std::vector<std::string_view>& needed() const { return needed_; }
  /// Returns the folders to search for them, separated by ':'; "$ORIGIN" is the library's own folder.
  [[nodiscard]] std::string_view search_path() const { return search_path_; }

  /// Returns the bytes of the file that belong to an address; nothing if they are not all in the file.
  [[nodiscard]] std::optional<Bytes> at_address(std::uint64_t address, std::size_t size) const;
  /// Returns the parts of the file that are loaded into memory; those alone that are run as machine code, or all.
  [[nodiscard]] std::vector<Bytes> loaded_parts(bool only_code) const;
  /// Returns the build id that the linker wrote, in hexadecimal digits; empty if there is none.
  [[nodiscard]] const std::string& build_id() const { return build_id_; }
  /// Returns a section by name; nothing if there is none, or no table of sections.
  [[nodiscard]] std::optional<Bytes> section(std::string_view name) const;

 private:
  struct Segment {
    std::uint64_t address;
    std::uint64_t offset;
    std::uint64_t size;
    bool code;
  };
  struct Dynamic;
  using Versions = std::vector<std::pair<std::string_view, std::string_view>>;

  explicit ElfFile(std::vector<std::byte> bytes) : bytes_(std::move(bytes)) {}

  Status read_header();
  Status read_segments();
  Status read_dynamic(std::uint64_t offset, std::uint64_t size, std::span<const Elf64_Phdr> segments);
  Status check_relocations(std::uint64_t table, std::uint64_t size,
                           std::span<const Elf64_Phdr> segments) const;
  Status read_symbols(const Dynamic& dynamic);
  [[nodiscard]] Versions read_versions(const Dynamic& dynamic) const;
  [[nodiscard]] std::size_t symbol_count(const Dynamic& dynamic) const;
  [[nodiscard]] std::size_t count_by_gnu_hash(std::uint64_t table) const;

  [[nodiscard]] std::optional<Bytes> at_offset(std::uint64_t offset, std::uint64_t size) const;
  /// Return a plain structure at an offset in the file, or at an address.
  template <class T>
  [[nodiscard]] std::optional<T> get(std::uint64_t offset) const;
  template <class T>
  [[nodiscard]] std::optional<T> get_at(std::uint64_t address) const;
  /// Returns a text of the table; empty if it does not end within the table.
  [[nodiscard]] static std::string_view text(Bytes table, std::uint64_t at);

  std::vector<std::byte> bytes_;
  std::vector<Segment> segments_;
  Bytes strings_;
  std::vector<ElfSymbol> symbols_;
  std::vector<std::string_view> needed_;
  std::string_view search_path_;
  std::string build_id_;
};

/// Returns a symbol's name as it is written in C++, or the name itself if it is not mangled.
[[nodiscard]] std::string demangled(std::string_view symbol);

/// Returns the build id that a linker wrote among the notes of a library, in hexadecimal digits; empty if there is none.
/// The bytes are not trusted.
///
/// @param align  of the segment of notes that the bytes are [bytes]; each note begins at a multiple of it.
/// @source  System V ABI, chapter 5, "Note Section"; NT_GNU_BUILD_ID as in glibc's <elf.h>.
[[nodiscard]] std::string build_id_in(std::span<const std::byte> notes, std::uint64_t align);

}  // namespace orca::plugin
