// SPDX-License-Identifier: GPL-3.0-or-later
// Additional permission: LICENSES/Orca-plugin-exception.txt
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "orca/base/descriptor.hpp"

namespace orca::guest {

/// A list of words, of text or of bytes.
using Packet = std::vector<std::string>;

/// A stream of packets to a program and from it: the bytes that follow, and for each word its bytes and the word, all numbers of 32 bits,
/// little-endian.
///
/// Thread contract: not synchronised; one thread at a time, but end_input() from any.
class PacketLine {
 public:
  /// @param socket  programs that this one starts do not inherit it.
  explicit PacketLine(Descriptor socket);

  /// Sends a packet. Nothing happens if the program is gone: receive() finds that.
  void send(const Packet& packet);
  /// Waits for the next packet and returns it; nothing if the program is gone, or sends what is none.
  [[nodiscard]] std::optional<Packet> receive();
  /// Lets receive() find nothing more, also one that waits.
  void end_input();

 private:
  [[nodiscard]] bool read(char* to, std::size_t count);

  Descriptor socket_;
};

}  // namespace orca::guest
