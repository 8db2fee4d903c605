// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <sys/types.h>

#include <cstddef>
#include <memory>

#include "comparison.hpp"

namespace orca::bench {

/// Two processes that pass pieces of memory to each other by iceoryx, which copies nothing: each lends a piece, publishes it, and waits for
/// the other's. A third process has its daemon, RouDi. Nothing is written into the pieces, as nothing is into Orca's images while they are timed.
class BareIceoryxPair {
 public:
  /// @param size  [bytes] of a piece.
  explicit BareIceoryxPair(std::size_t size);
  ~BareIceoryxPair();
  BareIceoryxPair(const BareIceoryxPair&) = delete;
  BareIceoryxPair& operator=(const BareIceoryxPair&) = delete;

  /// @return time from one process to the other [ns].
  Nanoseconds time(int round_trips);

 private:
  struct Ends;

  const std::size_t size_;
  pid_t daemon_ = -1;
  pid_t child_ = -1;
  std::unique_ptr<Ends> ends_;
};

}  // namespace orca::bench
