// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <sys/socket.h>
#include <sys/types.h>

#include <string>
#include <vector>

#include "orca/base/descriptor.hpp"
#include "orca/base/result.hpp"
#include "orca/supervisor/role.hpp"

namespace orca::supervisor {

/// Who is at the other end of a socket, as the system says.
struct Asker {
  ucred who{0, ~uid_t{0}, ~gid_t{0}};
  std::vector<gid_t> groups{};  ///< Without the first one, which is in `who`.
};

/// Returns who has connected to a Unix socket; nobody if the system does not know.
/// @thread  any.
[[nodiscard]] Asker asker_at(const Descriptor& socket);

/// A role that the owner of a system gives to a user, or to all of a group. A plain value.
struct Grant {
  Access access = Access::none;
  bool is_group = false;
  id_t id = 0;  ///< Of the user or the group.
};

/// Reads "observe=user:anna", "operate=group:robots", or numbers in the place of names.
/// @errors  invalid_argument if it is no such text, or the system knows no such user or group.
/// @thread  any; the system may ask a server for the name.
[[nodiscard]] Result<Grant> read_grant(const std::string& text);

/// Returns what somebody may do: everything if it is this process's user or root, otherwise the most of what is granted.
/// @thread  any.
[[nodiscard]] Access access_of(const Asker& asker, const std::vector<Grant>& grants);

}  // namespace orca::supervisor
