// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <memory>

#include "orca/base/executive.hpp"

namespace orca {

/// The carrier of everything that is under way between two ports for some virtual time. Things that are due arrive before any
/// component has its turn at that instant, in the order in which they were posted.
///
/// It has a task of its own, from the first post() on.
/// Thread contract: tasks of the executive, which is one that runs one task at a time.
class Courier {
 public:
  explicit Courier(Executive& executive) : executive_(executive) {}
  ~Courier() { end(); }
  Courier(const Courier&) = delete;
  Courier& operator=(const Courier&) = delete;

  /// Calls a function after some time. It must neither block nor throw.
  /// @param owner   for recall().
  /// @param number  for recall(), among what the owner has posted.
  void post(const void* owner, Duration delay, std::function<void()> arrive, std::uint64_t number = 0);

  /// Forgets everything that an owner has under way.
  void recall(const void* owner);
  /// Forgets what an owner has under way by that number.
  /// @return whether there was anything.
  bool recall(const void* owner, std::uint64_t number);

  /// Forgets everything, now and from now on, and ends the task. The destructor does so as well.
  void end();

 private:
  struct Letter {
    const void* owner;
    std::uint64_t number;
    std::function<void()> arrive;
  };

  void carry();

  Executive& executive_;
  std::multimap<TimePoint, Letter> letters_;  // by the time at which they are due
  std::unique_ptr<Event> posted_;             // there is a new first letter, or the end
  bool ended_ = false;
  std::unique_ptr<Task> task_;  // null until the first letter
};

}  // namespace orca
