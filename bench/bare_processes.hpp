// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <sys/types.h>

#include <cstddef>
#include <vector>

namespace orca::bench {

/// Two processes that pass bytes to each other through two rings in shared memory, each with a futex for the reader
/// that sleeps: the barest link that does what Orca's does. The bytes are copied in and out.
class BareProcessPair {
 public:
  /// @param size  [bytes] of a message, each way.
  explicit BareProcessPair(std::size_t size);
  ~BareProcessPair();
  BareProcessPair(const BareProcessPair&) = delete;
  BareProcessPair& operator=(const BareProcessPair&) = delete;

  /// @return time from one process to the other [ns].
  double time(int round_trips);

 private:
  struct Ring;

  void put(Ring& ring, const std::vector<std::byte>& from) const;
  void take(Ring& ring, std::vector<std::byte>& to) const;
  [[noreturn]] void echo();

  const std::size_t size_;
  std::vector<std::byte> sent_;
  std::vector<std::byte> received_;
  void* memory_;
  Ring* there_;
  Ring* back_;
  pid_t child_ = -1;
};

}  // namespace orca::bench
