// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <set>
#include <string>

namespace orca::keys {

/// What a process of a secured system may do. A plain value.
struct Permit {
  std::string machine;           ///< Empty: the graph declares none.
  std::string process;           ///< Name in the graph, or kPeersKeys.
  std::set<std::string> writes;  ///< Topics of DDS; '*' stands for any text.
  std::set<std::string> reads;
};

}  // namespace orca::keys
