// SPDX-License-Identifier: GPL-3.0-or-later
// Additional permission: LICENSES/Orca-plugin-exception.txt
#pragma once

#include "common/command_line.hpp"
#include "orca/base/descriptor.hpp"

namespace orca::orcactl {

/// Loads the libraries of object types that a running system has loaded, so that its objects can be shown here. A library that cannot be
/// loaded is reported on stderr; objects of its types are not known here then. So does the next function.
/// @param system  a connection of its own, which is closed afterwards.
void learn_objects(Descriptor system);

/// Does the same with the system that a call names, if it runs.
void learn_objects(const apps::Call& call);

/// Loads the libraries in the folders of the option --plugins, for a call that needs no system.
void learn_objects_in_folders(const apps::Call& call);

}  // namespace orca::orcactl
