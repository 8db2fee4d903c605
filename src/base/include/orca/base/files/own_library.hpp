// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <string>

namespace orca {

/// Returns the path of a library that lies beside this one, for dlopen(). The loader would find it by name, but not under the
/// sanitizers, which stand between the caller and the loader.
[[nodiscard]] std::string beside_own_library(const std::string& name);

/// Returns the folder of Orca's own plugins, seen from the program: `../lib/orca/plugins` where Orca is installed, `../plugins` where
/// it was built.
[[nodiscard]] std::string own_plugin_folder();

/// Returns the path of one of Orca's own files which are no code, such as "web": below `../share/orca`, seen from the program.
[[nodiscard]] std::string own_file(const std::string& name);

/// Returns a file that a user names, or Orca's own of this name if there is only that: "graphs/scout_goto.xml" is found from
/// anywhere where Orca is installed.
[[nodiscard]] std::string or_own_file(const std::string& name);

}  // namespace orca
