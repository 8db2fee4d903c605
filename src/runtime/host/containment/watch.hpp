// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <optional>
#include <string>

#include "orca/host/alarm.hpp"

namespace orca::host {

/// A change that a component must not make.
struct Finding {
  AlarmKind kind;
  std::string deed;  ///< The words after "has": "changed the umask".
};

/// A watch over one kind of state that no component may change, because others depend on it.
///
/// Thread contract: one thread at a time; a watch over the state of a thread looks at that of its caller.
class Watch {
 public:
  Watch() = default;
  virtual ~Watch() = default;
  Watch(const Watch&) = delete;
  Watch& operator=(const Watch&) = delete;

  /// Records the present state as the reference.
  virtual void keep() = 0;

  /// Compares the state with the reference and restores it. A change that cannot be undone becomes part of
  /// the reference, so that it is reported once.
  /// @return the change; nothing if there is none.
  virtual std::optional<Finding> look() = 0;
};

}  // namespace orca::host
