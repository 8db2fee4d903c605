// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

// The system's own header: <termios.h>, which cannot be included with it, knows no other rates than those of a list.
#include <asm/termbits.h>

#include <optional>
#include <string>

#include "orca/base/result.hpp"
#include "orca/hw/link/byte_link.hpp"

namespace orca::hw::link {

/// Makes the terminal carry bytes as they are, with this line and no flow control of any kind.
/// @param name  of the device, for messages.
/// @errors  invalid_argument: no terminal, or it cannot do this rate; unavailable with the system's reason.
/// @source  Linux tty ioctls: termios2 with BOTHER carries any rate.
[[nodiscard]] Status set_line(int terminal, const Line& line, const std::string& name);

/// Raises or lowers DTR. A terminal without that line, such as a pseudo terminal, is left as it is.
/// @errors  unavailable with the system's reason.
[[nodiscard]] Status set_dtr(int terminal, bool raised, const std::string& name);

/// Returns the line that is set; for a pseudo terminal's master, the line that the other side has set.
[[nodiscard]] std::optional<Line> line_of(int terminal);

/// What a terminal was set to before a link took it.
///
/// Thread contract: not synchronised.
class OldSettings {
 public:
  /// Reads the settings.
  /// @return 0, or errno if there are none; ENOTTY: this is no terminal.
  [[nodiscard]] int keep(int terminal);
  /// Asks the driver to deliver bytes as they come and not in groups (which costs FTDI adapters 16 ms), and raises the
  /// lines that tell the device that somebody is there. Drivers without these features are left as they are.
  void hurry(int terminal);
  /// Puts everything back.
  /// @param keeps_dtr  whether DTR stays as it is when the terminal is closed, whatever it was set to.
  void restore(int terminal, bool keeps_dtr);

 private:
  termios2 line_{};
  std::optional<int> flags_;  // of the driver, if they were changed
};

}  // namespace orca::hw::link
