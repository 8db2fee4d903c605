// SPDX-License-Identifier: LGPL-3.0-or-later
#include "orca/hw/link/serial_link.hpp"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/ioctl.h>
#include <sys/stat.h>

#include <algorithm>
#include <cerrno>
#include <thread>

#include "line_settings.hpp"
#include "orca/base/exhaustion.hpp"
#include "orca/base/files/open_output.hpp"
#include "orca/base/steady_clock.hpp"
#include "orca/hw/link/device_files.hpp"
#include "serial_trouble.hpp"

namespace orca::hw::link {
namespace {

constexpr Duration kLongestLastWords = 50ms;
constexpr Duration kHeldByAdapter = 20ms;  // a USB adapter collects bytes for 16 ms
constexpr std::chrono::milliseconds kPauseInLastWords{1};
constexpr Duration kLongestHold = 500ms;  // of the line, while bytes wait

// Opened as a file, some devices do things: a watchdog starts to count. So it is looked at before.
Status check_kind(const std::string& path, const std::string& name) {
  struct stat about {};
  if (stat(path.c_str(), &about) != 0 || S_ISCHR(about.st_mode)) return ok();  // open() says what is wrong
  const std::string kind = S_ISDIR(about.st_mode) ? "a folder" : "a file";
  return fail(Code::invalid_argument, path + " is " + kind + ", not a serial device", name);
}

}  // namespace

SerialLink::SerialLink(SerialOptions options)
    : StreamLink(Kind::terminal, "the device has gone: was it unplugged or switched off?"),
      options_(std::move(options)),
      places_(std::make_unique<SerialPlaces>(options_.folder)),
      old_(std::make_unique<OldSettings>()) {}

SerialLink::~SerialLink() { SerialLink::close(); }

Result<Opening> SerialLink::open() {
  if (is_attached()) return Opening::done;
  const Result<std::string> path = locate();
  if (!path) return path.error();
  Result<Descriptor> terminal = claim(*path);
  if (!terminal && terminal.error().code == Code::not_found && goes_on_waiting()) return Opening::under_way;
  waits_since_.reset();
  if (!terminal) return terminal.error();
  path_ = resolved(*path);
  if (identity_.empty() && !places_->holds(*path)) identity_ = places_->identity_of(*path);
  attach(std::move(*terminal));
  flowed_ = steady_now();
  waited_ = 0;
  return Opening::done;
}

bool SerialLink::goes_on_waiting() {
  if (!waits_since_) waits_since_ = options_.now();
  return options_.now() - *waits_since_ < options_.patience;
}

// Returns the path of the adapter that was opened first, wherever it is now.
Result<std::string> SerialLink::locate() const {
  const std::string named = places_->path_of(options_.device);
  if (identity_.empty()) return named;
  if (!resolved(identity_).empty()) return identity_;
  if (resolved(named).empty()) return identity_;  // open() says that it is not there
  return fail(Code::not_found,
              identity_ + " is not plugged in, and " + named +
                  " is another device now; plug in the first one, or start again to use the other",
              name());
}

// Opens a device for this link alone.
Result<Descriptor> SerialLink::claim(const std::string& path) {
  if (options_.check)
    if (const Status trusted = options_.check(); !trusted.ok()) return trusted.error();
  if (const Status trusted = check_output_place(path); !trusted.ok())
    return fail(trusted.error().code, path + ": " + trusted.error().message, name());
  if (const Status kind = check_kind(path, name()); !kind.ok()) return kind.error();
  Descriptor terminal(::open(path.c_str(), O_RDWR | O_NOCTTY | O_NONBLOCK | O_CLOEXEC));
  if (!terminal) {
    const int reason = errno;
    throw_if_exhausted(reason);
    return explain_refusal(path, reason, *places_, name());
  }
  const int reason = old_->keep(terminal.number());
  if (reason == ENOTTY || reason == EINVAL)
    return fail(Code::invalid_argument, path + " is no serial device", name());
  if (reason != 0)
    return explain_refusal(path, reason, *places_, name());  // a port that its board does not have
  // The lock keeps out other programs of Orca and root's, which the exclusive mode lets in.
  if (flock(terminal.number(), LOCK_EX | LOCK_NB) != 0) {
    terminal.reset();
    return explain_holder(path, name());
  }
  if (const Status taken = take(terminal.number()); !taken.ok()) return taken.error();
  return terminal;
}

Status SerialLink::take(int terminal) {
  if (Status set = link::set_line(terminal, options_.line, name()); !set.ok()) {
    old_->restore(terminal, dtr_.has_value());
    return set;
  }
  (void)ioctl(terminal, TIOCEXCL);
  old_->hurry(terminal);
  if (dtr_)
    if (Status set = link::set_dtr(terminal, *dtr_, name()); !set.ok()) return set;
  (void)ioctl(terminal, TCFLSH, TCIOFLUSH);
  return ok();
}

void SerialLink::close() {
  if (!is_attached()) return;
  const int terminal = descriptor();
  let_last_words_out();
  if (pending() > 0) (void)ioctl(terminal, TCFLSH, TCOFLUSH);  // or closing waits for a stuck device
  old_->restore(terminal, dtr_.has_value());
  (void)ioctl(terminal, TIOCNXCL);
  (void)flock(terminal, LOCK_UN);  // a copy of this process may still hold the descriptor
  detach();
  path_.clear();
}

// The last words are often "stop". What they need is known from the rate, since adapters do not tell what they still hold; they
// must not go out at the rate that is set back.
void SerialLink::let_last_words_out() {
  const TimePoint latest = steady_now() + kLongestLastWords;
  while (steady_now() < latest && flush().ok() &&
         (pending() > 0 || steady_now() < busy_until_ + kHeldByAdapter))
    std::this_thread::sleep_for(kPauseInLastWords);
}

// Fails when bytes wait and none of them has gone for too long.
Status SerialLink::check_flow() {
  const std::size_t waiting = pending();
  const TimePoint now = steady_now();
  if (waiting == 0 || waiting < waited_) flowed_ = now;
  waited_ = waiting;
  if (now - flowed_ < kLongestHold) return ok();
  return fail(
      Code::deadline_exceeded,
      "the device takes nothing any more, " + std::to_string(waiting) +
          " bytes wait; is the line held back by flow control (an XOFF, a cable with RTS and CTS), or "
          "does its adapter hang? Then unplug it and plug it in again",
      name());
}

Result<std::size_t> SerialLink::read(std::span<std::uint8_t> into) {
  Result<std::size_t> count = StreamLink::read(into);
  if (!count || *count > 0) return count;
  const Status flows = check_flow();
  return flows.ok() ? count : flows.error();
}

Status SerialLink::write(std::span<const std::uint8_t> bytes) {
  Status written = is_attached() ? check_flow() : ok();
  if (written.ok()) written = write_paced(bytes);
  if (!written.ok()) return written;
  waited_ = pending();
  busy_until_ =
      std::max(busy_until_, steady_now()) + from_seconds(static_cast<double>(bytes.size()) * byte_time());
  return written;
}

Status SerialLink::write_paced(std::span<const std::uint8_t> bytes) {
  if (options_.line.pause == Duration{0}) return StreamLink::write(bytes);
  if (Status fits = check_size(*this, bytes.size()); !fits.ok()) return fits;
  for (const std::uint8_t& byte : bytes) {
    if (Status written = StreamLink::write({&byte, 1}); !written.ok()) return written;
    std::this_thread::sleep_for(options_.line.pause);
  }
  return ok();
}

std::size_t SerialLink::pending() const {
  int held = 0;
  if (!is_attached() || ioctl(descriptor(), TIOCOUTQ, &held) != 0 || held < 0) held = 0;
  return StreamLink::pending() + static_cast<std::size_t>(held);
}

void SerialLink::discard_input() {
  if (is_attached()) (void)ioctl(descriptor(), TCFLSH, TCIFLUSH);
}

void SerialLink::discard_output() {
  StreamLink::discard_output();
  busy_until_ = {};
  waited_ = 0;
  if (is_attached()) (void)ioctl(descriptor(), TCFLSH, TCOFLUSH);
}

Status SerialLink::set_line(const Line& line) {
  if (is_attached())
    if (Status set = link::set_line(descriptor(), line, name()); !set.ok()) return set;
  options_.line = line;
  return ok();
}

Status SerialLink::set_dtr(bool raised) {
  dtr_ = raised;
  return is_attached() ? link::set_dtr(descriptor(), raised, name()) : ok();
}

}  // namespace orca::hw::link
