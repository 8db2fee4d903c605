// SPDX-License-Identifier: GPL-3.0-or-later
// Additional permission: LICENSES/Orca-plugin-exception.txt
#pragma once

#include <string>
#include <vector>

#include "orca/idl/object_type.hpp"

namespace orca::deployer {

/// Returns the text that `--describe` prints of object types: for each its fields with kind and unit, without those of OrcaObject.
/// @param library  file that has them; empty: they are Orca's own.
[[nodiscard]] std::string objects_text(const std::vector<const ObjectType*>& types,
                                       const std::string& library);
/// Returns the same for programs: {file, types: [{type, kind: "object", parent, hash, fields: [{name, kind, unit}]}]}.
[[nodiscard]] std::string objects_json(const std::vector<const ObjectType*>& types,
                                       const std::string& library);

}  // namespace orca::deployer
