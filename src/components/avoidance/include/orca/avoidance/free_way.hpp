// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include "orca/avoidance/advice.hpp"
#include "orca/avoidance/echo_memory.hpp"
#include "orca/component.hpp"

namespace orca::avoid {

/// The advice of avoid(), a member of the components that give it, with the parameter that only it needs.
///
/// Thread contract: as Param.
class FreeWay {
 public:
  /// @param owner  the component; it gets the parameter `side_distance`.
  explicit FreeWay(Component& owner);

  /// Returns the advice of avoid(), with the side distance of the parameter. A body that is to pass where its circle does
  /// not has none.
  [[nodiscard]] Advice advice(const EchoMemory& memory, const Situation& situation, Limits limits) const;

 private:
  Param<double> side_distance_;
};

}  // namespace orca::avoid
