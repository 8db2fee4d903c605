// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <optional>
#include <string_view>

namespace orca::plugin {

/// The reason why a symbol must not be used in virtual time.
struct UnfitSymbol {
  const char* does;     ///< "reads the machine's clock"
  const char* instead;  ///< "now()"
};

/// Returns why a symbol that a plugin needs from another library must not be used in virtual time; nothing if
/// it may. The name is mangled, as in the file. Clocks, sleeps, threads, waits for threads, random devices,
/// questions about the machine and waits for devices would make a run depend on the machine, or hold up virtual
/// time.
[[nodiscard]] std::optional<UnfitSymbol> unfit_for_virtual_time(std::string_view symbol);

/// Returns whether a plugin that uses the symbol can start threads.
[[nodiscard]] bool starts_threads(std::string_view symbol);

}  // namespace orca::plugin
