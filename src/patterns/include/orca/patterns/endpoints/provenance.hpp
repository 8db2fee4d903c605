// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <cstdint>
#include <string>

#include "orca/idl/object.hpp"

namespace orca {

/// The cause and the mission of a component's present activity, stamped on everything that it sends
/// meanwhile.
///
/// The cause is the object taken last. The mission is that of the last object that had one; an object without
/// a mission, such as most sensor readings, does not change it. A lap starts with the mission of the
/// component's task, which is the mission of the object that a Send handler took last.
///
/// Thread contract: the component's strand.
class Provenance {
 public:
  void begin_lap() { mission_ = task_mission_; }
  /// Begins to handle an object: everything sent meanwhile belongs to its mission, or to none.
  void begin_handling(const idl::OrcaObject& object);
  /// Does the same for a Send handler, whose object gives the component its task.
  void begin_task(const idl::OrcaObject& object);
  /// Forgets the task, because the component has nothing more to do.
  void end_task() { task_mission_ = mission_ = 0; }

  /// Makes a received object the cause of everything sent from now on.
  void note(const idl::OrcaObject& received);
  /// Writes cause and mission into the header of an object to be sent.
  void stamp(idl::OrcaObject& sent) const;

  [[nodiscard]] std::uint64_t mission() const { return mission_; }

 private:
  std::uint64_t mission_ = 0;  // 0: none
  std::uint64_t task_mission_ = 0;
  std::string origin_;
  std::uint64_t seq_ = 0;
};

}  // namespace orca
