// SPDX-License-Identifier: LGPL-3.0-or-later
#include "line_settings.hpp"

#include <linux/serial.h>
#include <linux/tty_flags.h>
#include <sys/ioctl.h>

#include <cerrno>
#include <cstring>

namespace orca::hw::link {
namespace {

constexpr std::uint32_t kSlowest = 50;
constexpr std::uint32_t kFastest = 4'000'000;
// A receiver samples the middle of the tenth bit: half a bit of ten is what both sides together may be off.
constexpr double kMostDeviation = 0.03;

void make_raw(termios2& settings, const Line& line) {
  settings.c_iflag = IGNBRK;  // IXON and IXOFF stay off: a byte 0x13 from the device must not stop our output
  settings.c_oflag = 0;
  settings.c_lflag = 0;
  const bool even = line.parity == Parity::even;
  if (even) settings.c_iflag |= INPCK;  // a byte with wrong parity arrives as zero, and the checksum finds it
  const tcflag_t hangs_up = settings.c_cflag & HUPCL;
  settings.c_cflag = CS8 | CREAD | CLOCAL | BOTHER | (BOTHER << IBSHIFT) | hangs_up;
  if (even) settings.c_cflag |= PARENB;
  settings.c_ispeed = line.baud;
  settings.c_ospeed = line.baud;
  settings.c_cc[VMIN] = 1;  // with 0, "nothing now" and "hung up" would both read as zero bytes
  settings.c_cc[VTIME] = 0;
}

Error cannot_set(const std::string& name, int reason) {
  if (reason == ENOTTY || reason == EINVAL)
    return fail(Code::invalid_argument, "this is no serial device: " + std::string(std::strerror(reason)),
                name);
  return fail(Code::unavailable,
              "the serial device does not answer its driver: " + std::string(std::strerror(reason)) +
                  "; is anything connected there?",
              name);
}

Error wrong_rate(const Line& line, const std::string& what, const std::string& name) {
  return fail(Code::invalid_argument,
              std::to_string(line.baud) + " baud cannot be had: " + what + "; choose another rate or adapter",
              name);
}

}  // namespace

Status set_line(int terminal, const Line& line, const std::string& name) {
  if (line.baud < kSlowest || line.baud > kFastest)
    return wrong_rate(line, "rates are " + std::to_string(kSlowest) + " to " + std::to_string(kFastest),
                      name);
  termios2 settings{};
  if (ioctl(terminal, TCGETS2, &settings) != 0) return cannot_set(name, errno);
  make_raw(settings, line);
  if (ioctl(terminal, TCSETS2, &settings) != 0) return cannot_set(name, errno);
  if (ioctl(terminal, TCGETS2, &settings) != 0) return cannot_set(name, errno);
  const double got = settings.c_ospeed;
  if (got < line.baud * (1 - kMostDeviation) || got > line.baud * (1 + kMostDeviation))
    return wrong_rate(line, "the adapter gives " + std::to_string(settings.c_ospeed), name);
  return ok();
}

Status set_dtr(int terminal, bool raised, const std::string& name) {
  const int line = TIOCM_DTR;
  if (ioctl(terminal, raised ? TIOCMBIS : TIOCMBIC, &line) == 0) return ok();
  const bool has_none = errno == ENOTTY || errno == EINVAL;
  return has_none ? ok() : Status(cannot_set(name, errno));
}

std::optional<Line> line_of(int terminal) {
  termios2 settings{};
  if (ioctl(terminal, TCGETS2, &settings) != 0) return std::nullopt;
  return Line{settings.c_ospeed, (settings.c_cflag & PARENB) != 0 ? Parity::even : Parity::none};
}

int OldSettings::keep(int terminal) {
  flags_.reset();
  return ioctl(terminal, TCGETS2, &line_) == 0 ? 0 : errno;
}

void OldSettings::hurry(int terminal) {
  serial_struct about{};
  constexpr int kLowLatency = static_cast<int>(ASYNC_LOW_LATENCY);
  if (ioctl(terminal, TIOCGSERIAL, &about) == 0 && (about.flags & kLowLatency) == 0) {
    const int before = about.flags;
    about.flags |= kLowLatency;
    if (ioctl(terminal, TIOCSSERIAL, &about) == 0) flags_ = before;
  }
  const int present = TIOCM_DTR | TIOCM_RTS;
  (void)ioctl(terminal, TIOCMBIS, &present);
}

void OldSettings::restore(int terminal, bool keeps_dtr) {
  serial_struct about{};
  if (flags_ && ioctl(terminal, TIOCGSERIAL, &about) == 0) {
    about.flags = *flags_;
    (void)ioctl(terminal, TIOCSSERIAL, &about);
  }
  if (keeps_dtr) line_.c_cflag &= ~static_cast<tcflag_t>(HUPCL);
  (void)ioctl(terminal, TCSETS2, &line_);
}

}  // namespace orca::hw::link
