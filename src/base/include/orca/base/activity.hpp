// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

namespace orca {

/// What a task is doing and for whom, as long as the object lives: for the last words of a process that dies
/// of it. Activities nest; the innermost is the current one. It moves along when a task on a fiber is
/// switched to.
///
/// Thread contract: made and destroyed by one task. current() also from a signal handler.
class Activity {
 public:
  /// @param who   a component, a hardware container or a type; must outlive this, as `what` must.
  /// @param what  the hook, for people: "work()".
  /// @param code  an address in the plugin whose code runs; null: none.
  Activity(const char* who, const char* what, const void* code) noexcept;
  ~Activity();
  Activity(const Activity&) = delete;
  Activity& operator=(const Activity&) = delete;

  /// Of the task that asks; null: it runs no plugin's code.
  [[nodiscard]] static const Activity* current() noexcept;

  [[nodiscard]] const char* who() const { return who_; }
  [[nodiscard]] const char* what() const { return what_; }
  [[nodiscard]] const void* code() const { return code_; }

 private:
  friend class ActivityKeeper;

  const char* who_;
  const char* what_;
  const void* code_;
  const Activity* outer_;
};

/// Where the current activity stays while its task does not run: for whoever switches tasks on one thread.
class ActivityKeeper {
 public:
  /// Keeps what is current, of the task that is left.
  void keep() noexcept;
  /// Makes current what was kept, of the task that is entered; at first: nothing.
  void restore() const noexcept;

 private:
  const Activity* kept_ = nullptr;
};

}  // namespace orca
