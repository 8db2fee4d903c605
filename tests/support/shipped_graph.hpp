// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

namespace orca::test {

/// A graph of graphs/ that a test changes before it is run.
class ShippedGraph {
 public:
  /// @param name  as "scout_goto".
  explicit ShippedGraph(const std::string& name);

  /// Takes a component away with all that names it: its connections, and its place in lists of behaviours.
  void remove(const std::string& component);
  /// Adds test.MotionWatch, which reports in the log when the robot moves and rests.
  /// @param base  name of the component that gives its odometry.
  void watch_motion(const std::string& base);

  [[nodiscard]] const std::string& text() const { return text_; }

 private:
  std::string text_;
};

/// Returns the names of all shipped graphs, as "scout_goto", sorted.
[[nodiscard]] std::vector<std::string> shipped_graphs();

}  // namespace orca::test
