// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <atomic>
#include <cstdint>

namespace orca::frames {

/// The counters of ends of links: of all that share them.
struct Traffic {
  std::atomic<std::uint64_t> frames_received{0};
  std::atomic<std::uint64_t> objects_lost{0};
  std::atomic<std::uint64_t> peers_cut_off{0};
};

}  // namespace orca::frames
