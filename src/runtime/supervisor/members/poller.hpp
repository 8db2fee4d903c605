// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <poll.h>

#include <vector>

#include "member.hpp"
#include "orca/base/descriptor.hpp"
#include "orca/supervisor/moment.hpp"

namespace orca::supervisor {

/// The place where the supervisor sleeps until one of its processes has something for it.
///
/// Thread contract: wake() from any thread, the rest from the supervisor's.
class Poller {
 public:
  /// @errors  throws std::system_error if there are no descriptors left (orca/base/exhaustion.hpp).
  Poller();

  /// Waits until a process has sent a message, written something or ended, until one of the others is ready, until wake(),
  /// or until that moment.
  void wait(const Members& members, const std::vector<pollfd>& others, Moment until);
  /// Ends the present wait, or the next one.
  void wake() const;

 private:
  const Descriptor wake_;
};

}  // namespace orca::supervisor
