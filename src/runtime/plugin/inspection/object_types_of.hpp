// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "elf_file.hpp"
#include "orca/base/contract.hpp"

namespace orca::plugin {

/// A function that returns the type of that name in this process; a TypeId without a name if there is none.
using KnownType = std::function<TypeId(const std::string& name)>;

/// Returns a type of this process; a TypeId without a name if there is none.
[[nodiscard]] TypeId known_type(const std::string& name);

/// Returns the layouts "NAME{...}" or "NAME:PARENT{...}" that a library carries: for a plugin those that it was built with, for a
/// library of object types its own.
[[nodiscard]] std::vector<std::string_view> layouts_in(const ElfFile& library);

/// Returns the name of the type that has the layout.
[[nodiscard]] std::string_view name_in(std::string_view layout);

/// Returns the object types that a library uses and that this process does not have, or not in that layout, each with what to do.
/// The symbols and layouts are not trusted.
[[nodiscard]] std::vector<std::string> type_faults(const ElfFile& library, const KnownType& known);

/// Returns every reason not to load a library of object types: it is none, it was built for another Orca, or its types hold or extend
/// others that have another layout here. Empty if none was found.
[[nodiscard]] std::vector<std::string> object_library_faults(const ElfFile& library, const KnownType& known);

/// The symbol that a library of object types exports (cmake/plugin/object_library_entry.cpp).
inline constexpr std::string_view kObjectLibrary = "orca_object_library";

}  // namespace orca::plugin
