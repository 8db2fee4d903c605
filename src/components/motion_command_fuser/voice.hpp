// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <limits>
#include <string>

#include "wish.hpp"

namespace orca::fuse {

/// The last message of a behaviour that the fuser listens to.
struct Voice {
  enum class Said { nothing, dont_care, full_stop, wish };

  std::string name;
  Said said = Said::nothing;                                  ///< Last of all.
  double age = std::numeric_limits<double>::infinity();       ///< [s] since then.
  Wish wish = {};                                             ///< The last one, if it ever had one.
  double wish_age = std::numeric_limits<double>::infinity();  ///< [s] since then.
  /// [s] silence of this behaviour that stops the robot; infinity: it may be silent.
  double silence_limit = std::numeric_limits<double>::infinity();
  bool lost = false;  ///< It fell silent, and does not speak regularly again yet.
};

}  // namespace orca::fuse
