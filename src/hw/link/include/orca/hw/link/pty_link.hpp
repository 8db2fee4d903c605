// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <memory>
#include <optional>
#include <string>

#include "orca/hw/link/stream_link.hpp"

namespace orca::hw::link {

/// The device's side of a serial line that exists only within this machine (a pseudo terminal), for emulators and
/// tests. A driver opens the other side, device(), as if it were a serial port.
///
/// As long as no driver has opened the other side, nothing is read and a few kilobytes may be written, which the driver
/// finds unless it discards them. When the driver has closed it, read() and write() give unavailable until it is opened
/// again; the link itself may stay open meanwhile. Each open() makes a new terminal.
///
/// Thread contract: one strand.
class PtyLink final : public StreamLink {
 public:
  /// @param symlink  a path that leads to device() while the link is open; empty: none. An older link of this name is
  ///                 replaced, anything else is not.
  explicit PtyLink(std::string symlink = {});
  ~PtyLink() override;

  /// @errors  already_exists if `symlink` is no symbolic link; unavailable with the system's reason.
  [[nodiscard]] Result<Opening> open() override;
  void close() override;
  [[nodiscard]] std::string name() const override;
  /// Returns the time that one byte takes at the driver's rate [s]; 0: the link is closed.
  [[nodiscard]] double byte_time() const override;

  /// Returns the path that a driver opens; empty: the link is closed.
  [[nodiscard]] const std::string& device() const { return device_; }

  /// Lets the link tell whether a driver is there even before the first one: read() and write() give unavailable until one opens the other
  /// side, as they do after one has closed it.
  /// @pre  the link has just been opened.
  /// @errors  unavailable with the system's reason.
  [[nodiscard]] Status await_driver();

  /// Returns the line that the driver has set, so that an emulator can answer nonsense at a wrong rate; nothing: the link
  /// is closed. Linux keeps no parity for pseudo terminals.
  [[nodiscard]] std::optional<Line> line() const;

 private:
  [[nodiscard]] Status place_symlink() const;
  void remove_symlink() const;

  const std::string symlink_;
  std::string device_;
};

}  // namespace orca::hw::link
