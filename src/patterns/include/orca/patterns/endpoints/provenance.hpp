// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <cstdint>
#include <string>

#include "orca/idl/object.hpp"

namespace orca {

/// The cause and the mission of a component's present activity, stamped on everything that it sends
/// meanwhile.
///
/// The cause is the object taken last. The mission is, in this order:
/// * in a handler, the mission of the object that it handles;
/// * in a lap, the mission of the component's task: the one that the component has begun itself, or that of
///   the object that a Send handler accepted last;
/// * without either, the mission of the last object that had one. An object without a mission, such as most
///   sensor readings, does not change it.
///
/// Thread contract: the component's strand.
class Provenance {
 public:
  void begin_lap();
  /// Begins to handle an object: everything sent meanwhile belongs to its mission.
  void begin_handling(const idl::OrcaObject& object);
  /// Does the same for a Send handler, whose object gives the component its task.
  void begin_task(const idl::OrcaObject& object);
  /// Returns to the task before, because the handler has refused the object. Objects and log lines before
  /// the next lap or handler still belong to the object's mission.
  void refuse_task() { task_mission_ = mission_before_task_; }
  /// Begins a mission: the component's task from now on.
  void begin_mission(std::uint64_t mission);
  /// Forgets the task, because the component has nothing more to do.
  void end_task() { begin_mission(0); }

  /// Makes a received object the cause of everything sent from now on.
  void note(const idl::OrcaObject& received);
  /// Writes cause and mission into the header of an object to be sent.
  void stamp(idl::OrcaObject& sent) const;

  [[nodiscard]] std::uint64_t mission() const { return mission_; }

 private:
  std::uint64_t mission_ = 0;  // 0: none
  bool settled_ = false;       // whether objects that are taken leave the mission as it is
  std::uint64_t task_mission_ = 0;
  std::uint64_t mission_before_task_ = 0;
  std::string origin_;  // these three: identity of the cause
  std::string port_;
  std::uint64_t seq_ = 0;
};

}  // namespace orca
