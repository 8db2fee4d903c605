// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "deployer.hpp"

namespace orca::test {

class TempFolder;

/// A graph of graphs/ that a test changes before it is run.
class ShippedGraph {
 public:
  /// @param name  as "scout_goto".
  explicit ShippedGraph(const std::string& name);

  /// Takes a component away with all that names it: its connections, and its place in lists of behaviours.
  void remove(const std::string& component);
  /// Adds elements at its end.
  void add(const std::string& elements);
  /// Adds test.MotionWatch, which reports in the log when the robot moves and rests. It is called "watch", in the
  /// context of the base.
  /// @param base  name of the component that gives its odometry.
  void watch_motion(const std::string& base);

  [[nodiscard]] const std::string& text() const { return text_; }

 private:
  std::string text_;
};

/// Returns the names of all shipped graphs, as "scout_goto", sorted.
[[nodiscard]] std::vector<std::string> shipped_graphs();

/// Returns the arguments without which a shipped graph does not run. scout_hospital gets a hall with a pillar, because
/// the floor plan of the hospital is not in the repository, and replay a recording that is made here. The camera of camera has fewer
/// pixels.
/// @param folder  for files that the arguments name; to be kept until the end of the run.
[[nodiscard]] Words needed_arguments(const std::string& graph, const TempFolder& folder);

/// Returns a shipped graph as `--print` shows it: in its default profile, sub-graphs expanded.
[[nodiscard]] std::string printed(const std::string& graph);

}  // namespace orca::test
