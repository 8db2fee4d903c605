// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "orca/base/descriptor.hpp"
#include "orca/base/result.hpp"
#include "orca/emulators/firmware.hpp"
#include "orca/hw/link/byte_link.hpp"
#include "orca/hw/link/listen_link.hpp"
#include "orca/hw/link/memory_link.hpp"
#include "orca/hw/link/pty_link.hpp"

namespace orca::sim {

/// With what the place of a device begins that listens in the network.
inline constexpr std::string_view kListens = "listen:";

/// An emulated device with its line, which a driver opens as emulated:NAME, or with the port at which it listens, which a driver opens as
/// emulated:tcp:PORT, and programs of others as tcp:HOST:PORT. A device that has several hosts at once serves up to 16 there.
///
/// Thread contract: one strand.
class DeviceLine {
 public:
  /// @param place  name of the line, or listen:[ADDRESS:]PORT as make_link() reads it.
  DeviceLine(const std::string& place, std::unique_ptr<emulators::Firmware> firmware);

  /// @errors  already_exists if another system offers a line of that name; those of PtyLink::open() and ListenLink::open().
  Status open();
  /// Opens it as a line in memory, in virtual time: a driver in this process finds it in the same words, and nobody else.
  /// @param ring  called when a driver has written something; on its strand.
  /// @errors  already_exists if another emulation of this process offers a line of that name.
  Status open_in_memory(std::function<void()> ring);
  void close();
  /// Returns for people where a driver and other programs find it.
  [[nodiscard]] std::string where() const;
  /// Passes bytes on, as the line's rate allows.
  /// @return whether a driver, or any host, has the line open.
  bool exchange(TimePoint now);

 private:
  /// The place of one host: its connection, and what talks to it.
  struct Seat {
    std::unique_ptr<hw::link::ByteLink> link;
    std::unique_ptr<emulators::Firmware> firmware;
    bool is_taken = false;
  };

  [[nodiscard]] Status lock_name();
  [[nodiscard]] std::uint32_t baud() const;
  void exchange(Seat& seat, std::uint32_t baud, TimePoint now);
  void add_seat();

  const std::string name_;
  std::vector<Seat> seats_;                 // at least one
  hw::link::PtyLink* terminal_ = nullptr;   // the first seat's link, if it is one
  hw::link::ListenLink* port_ = nullptr;    // likewise
  hw::link::MemoryLink* memory_ = nullptr;  // likewise
  Descriptor lock_;                         // of the terminal's name, while it is open
};

}  // namespace orca::sim
