// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include "orca/base/executive.hpp"

namespace orca::detail {

/// A mark on the calling thread that it runs tasks of an executive, for the lifetime of the object. Marks nest.
class TaskThread {
 public:
  explicit TaskThread(const Executive& executive) noexcept;
  ~TaskThread();
  TaskThread(const TaskThread&) = delete;
  TaskThread& operator=(const TaskThread&) = delete;

 private:
  const Executive* const outer_;
};

}  // namespace orca::detail
