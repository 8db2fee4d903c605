// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>

namespace orca::bench {

/// Two threads that pass samples to each other through Fast DDS, each by a participant of its own over UDP on the loopback
/// interface: the barest program that does what Orca's link does. A thread waits for a sample, takes it, and writes one.
class BareDdsPair {
 public:
  /// @param size  [bytes] of a sample, each way.
  BareDdsPair(std::size_t size, std::uint32_t domain);
  ~BareDdsPair();
  BareDdsPair(const BareDdsPair&) = delete;
  BareDdsPair& operator=(const BareDdsPair&) = delete;

  /// @return time from one thread to the other [ns].
  double time(int round_trips);

 private:
  class Inside;
  const std::unique_ptr<Inside> inside_;
};

/// Lets one participant publish so many topics and another subscribe to them.
/// @param size  [bytes] of a sample.
/// @return time from nothing until each topic has carried a sample [ns].
double start_bare_dds(int topics, std::size_t size, std::uint32_t domain);

}  // namespace orca::bench
