// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <tuple>
#include <vector>

namespace orca::test {

/// What readelf of binutils prints about a shared library: an independent reader to compare with.
struct Readelf {
  struct Symbol {
    std::string name;
    std::string binding;  ///< "GLOBAL", "WEAK" or "UNIQUE"; local ones are left out.
    bool defined = false;
    std::uint64_t address = 0;  ///< Of defined ones.
    std::string version;        ///< Of those that are needed; empty: any.
    std::string version_of;     ///< File name of the library of that version.
  };
  struct Section {
    std::uint64_t offset = 0;
    std::uint64_t size = 0;
    bool has_bytes = false;
  };

  /// Runs readelf. An exception ends the test if it fails.
  explicit Readelf(const std::string& path);

  std::vector<Symbol> symbols;
  std::vector<std::string> needed;
  std::string search_path;
  std::string build_id;                     ///< Empty: none.
  std::map<std::string, Section> sections;  ///< By name; the first of each.
  std::vector<std::tuple<std::uint64_t, std::uint64_t, std::uint64_t>>
      segments;  ///< Offset, address, size in the file.
};

/// Returns a symbol as one line, for comparisons that show what differs.
std::string line_of(const Readelf::Symbol& symbol);

}  // namespace orca::test
