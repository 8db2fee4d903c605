// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include "orca/base/hook.hpp"

namespace orca {

/// The work of a task and the one for whom it works, as long as the object lives: for alarms and for the last words of a
/// process that dies of it. Activities nest; the innermost is the current one. It moves along when a task on
/// a fiber is switched to.
///
/// Thread contract: made and destroyed by one task. current() also from a signal handler.
class Activity {
 public:
  /// @param who   a component, a hardware container or a type; must outlive this, as `port` must.
  /// @param code  an address in the plugin whose code runs; null: none.
  /// @param port  whose handler runs; "" for other hooks.
  Activity(const char* who, Hook hook, const void* code, const char* port = "") noexcept;
  ~Activity();
  Activity(const Activity&) = delete;
  Activity& operator=(const Activity&) = delete;

  /// Returns the activity of the calling task; null: it runs no plugin's code.
  [[nodiscard]] static const Activity* current() noexcept;

  [[nodiscard]] const char* who() const { return who_; }
  [[nodiscard]] Hook hook() const { return hook_; }
  [[nodiscard]] const void* code() const { return code_; }
  [[nodiscard]] const char* port() const { return port_; }

 private:
  friend class ActivityKeeper;

  const char* who_;
  Hook hook_;
  const void* code_;
  const char* port_;
  const Activity* outer_;
};

/// The place where the current activity stays while its task does not run: for whoever switches tasks on one
/// thread.
class ActivityKeeper {
 public:
  /// Keeps the current activity, of the task that is left.
  void keep() noexcept;
  /// Makes the kept activity current, of the task that is entered; at first there is none.
  void restore() const noexcept;

 private:
  const Activity* kept_ = nullptr;
};

}  // namespace orca
