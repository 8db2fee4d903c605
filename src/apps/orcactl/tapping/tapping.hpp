// SPDX-License-Identifier: GPL-3.0-or-later
// Additional permission: LICENSES/Orca-plugin-exception.txt
#pragma once

#include "common/command_line.hpp"
#include "exit_code.hpp"
#include "orca/base/result.hpp"
#include "orca/idl/object.hpp"
#include "orca/supervisor/control.hpp"

namespace orca::orcactl {

/// Carries out echo, hz or latency: looks at the objects that pass a port.
[[nodiscard]] ExitCode tap(const apps::Call& call);

/// Decodes what a process sends about an object that has passed a port.
/// @errors  data_loss.
[[nodiscard]] Result<supervisor::Tapped> tapped(supervisor::Message message);
/// Returns the object itself.
/// @errors  data_loss.
[[nodiscard]] Result<ObjectRef> object_of(const supervisor::Tapped& passed);

}  // namespace orca::orcactl
