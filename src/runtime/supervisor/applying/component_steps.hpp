// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "control/joint_orders.hpp"
#include "members/member.hpp"
#include "orca/base/result.hpp"
#include "orca/supervisor/vocabulary.hpp"

namespace orca::supervisor {

/// Returns the steps that construct components in their processes, unconnected, and destroy them if one of them cannot be.
[[nodiscard]] std::vector<JointStep> arrival_steps(const std::vector<AddComponent>& components);

/// Tells processes of components that others have, so that connections to them can be made.
/// @errors  unavailable if one of the processes is just coming up, and so has not heard of it.
Status announce(const std::vector<AddComponent>& components, const std::vector<Member*>& all);

/// Tells processes that components, which others have, are gone.
void announce_end(const std::string& component, const std::string& process, const std::vector<Member*>& all);

}  // namespace orca::supervisor
