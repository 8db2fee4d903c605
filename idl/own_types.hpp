// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <span>
#include <string_view>

#include "orca/idl/object_type.hpp"

namespace orca::detail {

/// Returns the object types of Orca's own IDL files, sorted by name. Written by idl/tools/generate.py, like the next one.
[[nodiscard]] std::span<const ObjectType* const> own_object_types();

/// Returns the layouts of all structs and enums of these files, of those that travel as well.
[[nodiscard]] std::span<const std::string_view> own_part_layouts();

}  // namespace orca::detail
