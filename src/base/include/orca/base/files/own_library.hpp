// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <functional>
#include <string>

#include "orca/base/result.hpp"

namespace orca {

/// Loads one of Orca's libraries, which lies beside this one, if this process has not done so yet, and returns one of its functions.
/// The library stays in memory. So a process has only what it uses of large libraries of others: to load FCL takes 7 to 15 ms (ADR 0092).
///
/// Thread contract: any thread.
/// @errors  unavailable: there is no such library, or no such function in it.
[[nodiscard]] Result<void*> late_function(const std::string& library, const char* name);

/// The same with the type of the function, which the library exports as extern "C".
template <class Function>
[[nodiscard]] Result<std::reference_wrapper<Function>> late_function(const std::string& library,
                                                                     const char* name) {
  const Result<void*> found = late_function(library, name);
  if (!found) return found.error();
  return std::ref(*reinterpret_cast<Function*>(*found));
}

/// Returns the folder of Orca's own plugins, seen from the program: `../lib/orca/plugins` where Orca is installed, `../plugins` where
/// it was built.
[[nodiscard]] std::string own_plugin_folder();

/// Returns the path of one of Orca's own files which are no code, such as "web": below `../share/orca`, seen from the program.
[[nodiscard]] std::string own_file(const std::string& name);

/// Returns a file that a user names, or Orca's own of this name if there is only that: "graphs/scout_goto.xml" is found from
/// anywhere where Orca is installed.
[[nodiscard]] std::string or_own_file(const std::string& name);

/// Returns the end of a message about a file that is not there: which of Orca's own it may be meant for, as where a graph was copied and its
/// "../sim/worlds/office.xml" leads nowhere any more. Nothing if there is none with the last two names of the path, or more of them.
[[nodiscard]] std::string hint_at_own_file(const std::string& path);

}  // namespace orca
