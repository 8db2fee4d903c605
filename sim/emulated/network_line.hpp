// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "device_line.hpp"
#include "orca/emulators/firmware.hpp"
#include "orca/hw/link/tcp_link.hpp"
#include "orca/hw/link/tcp_listener.hpp"

namespace orca::sim {

/// An emulated device at a TCP port, where any program may connect: a device of the network, or a serial one behind a serial
/// server, which has no rate then.
///
/// A device that has one host at a time lets others wait until that has gone. One that has several serves up to 16. A client that
/// does not read what it is sent, so that 256 KiB wait for it, is disconnected: nothing is left out of a stream.
///
/// Thread contract: one strand.
class NetworkLine final : public DeviceLine {
 public:
  /// @param address, port  as those of TcpListener::open().
  NetworkLine(std::string address, std::uint16_t port, std::unique_ptr<emulators::Firmware> firmware);
  ~NetworkLine() override;

  /// @errors  those of TcpListener::open().
  Status open() override;
  void close() override;
  bool exchange(TimePoint now) override;
  [[nodiscard]] std::string name() const override { return listener_.name(); }

 private:
  class Seat;

  void add_seat();

  const std::string address_;
  const std::uint16_t port_;
  hw::link::TcpListener listener_;
  std::vector<std::unique_ptr<Seat>> seats_;  // at least one
};

}  // namespace orca::sim
