// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <string>

#include "orca/base/result.hpp"
#include "orca/base/time.hpp"

namespace orca::hw::link {

enum class Parity { none, even };

/// How bytes go over a line that has a rate: one start bit, eight data bits, the parity bit if there is one, one stop
/// bit. There is no flow control.
struct Line {
  std::uint32_t baud = 9600;  ///< [bit/s]
  Parity parity = Parity::none;
  std::chrono::microseconds pause{0};  ///< Time that the device needs between two bytes that it is sent [us].

  /// Returns the time that one byte takes [s].
  /// @pre  baud > 0
  [[nodiscard]] double byte_time() const { return (parity == Parity::none ? 10.0 : 11.0) / baud; }

  bool operator==(const Line&) const = default;
};

/// A clock, as the executive of the caller gives it.
using NowFunction = std::function<TimePoint()>;

/// The most bytes that wait inside a link to be sent, and the most that one write() takes.
inline constexpr std::size_t kMostPending = 4096;

enum class Opening {
  done,       ///< The link is open.
  under_way,  ///< The other end has not answered yet; call open() again soon.
};

/// A stream of bytes to a device and back: a serial line, a connection, a recording.
///
/// No function but close() waits for the device, so a strand may call them between two commands to the motors. The codes
/// of errors tell the caller what to do:
///
/// | code                | meaning                                                      | what to do            |
/// |---------------------|--------------------------------------------------------------|-----------------------|
/// | unavailable         | the other end has gone: unplugged, switched off, hung up     | close(), later open() |
/// | deadline_exceeded   | the other end has not taken what was written before          | as the driver decides |
/// | data_loss           | the system cannot read or write, for another reason          | close(), later open() |
/// | failed_precondition | the link is not open                                         | open()                |
///
/// What was written and not yet sent waits inside the link, at most kMostPending bytes. It goes on its way at each
/// write(), read() and flush(). A command that is overtaken by time should not wait there: a driver that finds
/// pending() > 0 leaves out a set-point.
///
/// Thread contract: one strand, except where a class says more.
class ByteLink {
 public:
  /// Closes it.
  virtual ~ByteLink() = default;
  ByteLink() = default;
  ByteLink(const ByteLink&) = delete;
  ByteLink& operator=(const ByteLink&) = delete;

  /// Opens the link, or goes on with that. What the device sent before is not delivered where the link can tell.
  /// @return done also if it is open already.
  /// @errors  not_found: there is no such device or host; unavailable: it is there and cannot be had now;
  ///          failed_precondition: this user may not open it; invalid_argument: it is something else, or cannot do this
  ///          rate; deadline_exceeded: it does not answer. The text says what to do. The link is then closed.
  [[nodiscard]] virtual Result<Opening> open() = 0;

  /// Closes the link and drops what waits in it; again if it is closed: nothing. It may take up to 50 ms, so that the
  /// command that was written last still gets to the device.
  virtual void close() = 0;

  /// Reads what is there.
  /// @return the number of bytes; 0: nothing now.
  /// @errors  see the class. What arrived before the other end went is delivered first if the system still has it.
  [[nodiscard]] virtual Result<std::size_t> read(std::span<std::uint8_t> into) = 0;

  /// Takes all of the bytes or, with an error, none of them, so that no packet is cut.
  /// @param bytes  at most kMostPending.
  /// @errors  see the class; invalid_argument for too many bytes.
  [[nodiscard]] virtual Status write(std::span<const std::uint8_t> bytes) = 0;

  /// Sends what waits, as far as the other end takes it.
  /// @errors  see the class, but never deadline_exceeded.
  [[nodiscard]] virtual Status flush() = 0;

  /// Returns how many bytes have been written and have, as far as can be known, not left this machine.
  [[nodiscard]] virtual std::size_t pending() const = 0;

  /// Drops what has arrived and was not read.
  virtual void discard_input() = 0;

  /// Drops what waits to be sent. The device may have got the first part of it.
  virtual void discard_output() = 0;

  /// Returns the descriptor that becomes readable when read() has something to say; -1: there is none, so read() must be
  /// asked from time to time. It changes when the link is opened again.
  [[nodiscard]] virtual int descriptor() const = 0;

  /// Lets a link without a descriptor call `ring` whenever read() may have something to say, from now until close().
  /// @param ring  may be called from another thread, and does not block.
  /// @return whether it will; false: as if nothing had been said.
  virtual bool ring_at_input(std::function<void()> /*ring*/) { return false; }

  /// Returns what the link leads to, for people, in the form that make_link() reads where there is one.
  [[nodiscard]] virtual std::string name() const = 0;

  /// Sets the rate, now if the link is open, and for each open() that follows. What waits may go out at either rate: wait
  /// until pending() is 0 and two bytes' time more. A link without a rate takes any.
  /// @errors  invalid_argument if the device cannot do it; see the class.
  [[nodiscard]] virtual Status set_line(const Line& /*line*/) { return ok(); }

  /// Raises or lowers the line DTR, which switches something on some devices (the motor of an RPLIDAR A1): now if the link is
  /// open, and after each open() that follows. As long as nobody has called it, DTR is raised while the link is open. Opening
  /// raises it for a moment in any case. A link without such a line does nothing: a connection, a pseudo terminal.
  /// @errors  see the class.
  [[nodiscard]] virtual Status set_dtr(bool /*raised*/) { return ok(); }

  /// Returns the time that one byte takes [s]; 0: the link has no rate.
  [[nodiscard]] virtual double byte_time() const { return 0.0; }
};

/// Opens a link and waits for that, on the system's clock; for tools and tests, never for a strand.
/// @errors  those of open(), and deadline_exceeded after `limit` [s].
/// @thread  the link's; it sleeps.
[[nodiscard]] Status open_within(ByteLink& link, Duration limit);

/// Returns the error of a function that needs an open link.
[[nodiscard]] Error not_open(const ByteLink& link);

/// Returns the error of a link that takes no more, because `waiting` bytes [bytes] wait already.
[[nodiscard]] Error takes_no_more(const ByteLink& link, std::size_t waiting);

/// Returns whether one write() may take so many bytes.
/// @errors  invalid_argument if they are too many.
[[nodiscard]] Status check_size(const ByteLink& link, std::size_t bytes);

}  // namespace orca::hw::link
