// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "orca/base/result.hpp"
#include "orca/plugin/index.hpp"
#include "orca/plugin/library.hpp"

namespace orca::plugin {

/// A library of object types that are not Orca's own, made by orca_generate_idl(). It stays in memory for ever, because it owns the
/// memory of its objects (docs/adr/0099).
struct ObjectLibrary {
  std::string file;                ///< Absolute path.
  std::vector<std::string> types;  ///< Names of its object types, sorted.
};

/// Loads a library of object types, whose types object_types() has from then on. One that is in memory already, from this file or from
/// another one of its name, is left as it is.
///
/// @param trial  whether its static initialisation is tried in a copy of the process before.
/// @errors  not_found or invalid_argument, with all reasons, for a file that is no such library, was built for another Orca, or has a
///          type whose name another library's type has; already_exists if a library of its name is in memory with other layouts;
///          internal or deadline_exceeded if the copy of the process did not survive; unavailable if there could be none. Except for
///          the last, a later call for the same file has the same result.
/// @thread  any.
Status load_object_library(const std::string& file, Trial trial = Trial::now);

/// Loads all libraries of object types in plugin folders. A library that is refused is logged once as a warning: it matters only to those
/// who use its types, and loading a plugin that does is an error.
/// @thread  any.
void load_object_libraries(const PluginIndex& index);

/// Returns the libraries of object types that are in memory, in the order in which they were loaded.
/// @thread  any.
[[nodiscard]] std::vector<ObjectLibrary> object_libraries();

}  // namespace orca::plugin
