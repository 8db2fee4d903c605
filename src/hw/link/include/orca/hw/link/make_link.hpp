// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <memory>
#include <string_view>

#include "orca/base/steady_clock.hpp"
#include "orca/hw/link/byte_link.hpp"

namespace orca::hw::link {

/// What a link's text does not say.
struct LinkOptions {
  Line line{};                   ///< Of a serial line, until set_line().
  NowFunction now = steady_now;  ///< The clock on which a recording is played.
  Duration connect_limit = 3s;   ///< For connections [s].
  bool is_virtual = false;       ///< That clock is virtual: emulated:NAME is then memory:NAME.
};

/// Makes a link, closed, from a text as it stands in a graph. Nothing is opened or looked for yet.
///
/// | text                             | link                                                            |
/// |----------------------------------|-----------------------------------------------------------------|
/// | /dev/ttyUSB0                     | a serial line                                                   |
/// | serial:/dev/ttyUSB0              | the same                                                        |
/// | serial:usb-FTDI_FT232R-if00      | a name in /dev/serial/by-id, /dev/serial/by-path or /dev        |
/// | tcp:scout.local:4000             | a connection; an IPv6 address stands in brackets: tcp:[::1]:4000 |
/// | emulated:scout                   | the driver's side of an emulation, as a serial line; open() waits 10 s for it |
/// | emulated:tcp:6665                | the same of one that listens on this machine, as a connection                 |
/// | memory:scout                     | the driver's side of an emulation in this process; open() waits 10 s for it    |
/// | pty:/tmp/scout                   | the device's side of a line, which the driver opens at that path |
/// | listen:6665                      | the device's side of connections from this machine; listen:0.0.0.0:6665: from anywhere |
/// | replay:run7.bytes                | a recording                                                     |
///
/// @errors  invalid_argument, with what is wrong and how a link is written.
/// @thread  any.
[[nodiscard]] Result<std::unique_ptr<ByteLink>> make_link(std::string_view text,
                                                          const LinkOptions& options = {});

/// Returns whether the link of that text works in virtual time: nothing at its other end has a clock of its own.
/// @thread  pure function; any.
[[nodiscard]] bool fits_virtual_time(std::string_view text);

/// Returns the path of the device that a serial link leads to now, whatever it is called in the text, and the text itself of any
/// other link, and of one that leads nowhere.
/// @thread  any.
[[nodiscard]] std::string real_place(std::string_view text);

/// Returns the path at which an emulation of that name offers its line: `emulated/NAME` in the folder of the user
/// (orca/base/files/own_folder.hpp).
/// @thread  any that may read the environment.
[[nodiscard]] std::string emulated_path(std::string_view name);

/// Makes the folder of that path if necessary.
/// @errors  unavailable, as OwnFolder::make(): it must be this user's alone.
/// @thread  any that may read the environment.
[[nodiscard]] Status make_emulated_folder();

}  // namespace orca::hw::link
