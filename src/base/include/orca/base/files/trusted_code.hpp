// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <string>

#include "orca/base/result.hpp"

namespace orca {

/// Checks that nobody can exchange a file of code who cannot run code as this user anyway: the file, its folder and all folders above belong
/// to this user, to root, or to the owner of the program that runs, and nobody else may write to them. A folder above may be
/// open to all if each keeps what is theirs there (sticky), as /tmp is. A group may write if it is the owner's private one, of the
/// same name and without other members, as with a umask of 002. Where a link leads is checked in the same way. Folders that
/// the program that runs is in as well are not looked at: there it could be exchanged itself.
/// @errors  failed_precondition with the path concerned and what to run; not_found if there is no such file.
/// @thread  any; one at a time if a group may write, because the system is asked for its name.
[[nodiscard]] Status check_trusted_code(const std::string& file);

}  // namespace orca
