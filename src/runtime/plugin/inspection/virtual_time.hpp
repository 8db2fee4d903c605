// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <optional>
#include <string_view>

namespace orca::plugin {

/// Why a symbol has no place in virtual time.
struct UnfitSymbol {
  const char* does;     ///< "reads the machine's clock"
  const char* instead;  ///< "now()"
};

/// Judges a symbol, mangled as in the file, that a plugin wants from another library: clocks, sleeps,
/// threads, waits for threads, random devices and waits for devices would make a run depend on the machine
/// that it runs on, or hold up virtual time. Nothing for all others.
[[nodiscard]] std::optional<UnfitSymbol> unfit_for_virtual_time(std::string_view symbol);

/// Whether who uses the symbol can start threads.
[[nodiscard]] bool starts_threads(std::string_view symbol);

}  // namespace orca::plugin
