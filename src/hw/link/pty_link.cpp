// SPDX-License-Identifier: LGPL-3.0-or-later
#include "orca/hw/link/pty_link.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <filesystem>

#include "line_settings.hpp"
#include "orca/base/exhaustion.hpp"
#include "orca/base/files/open_output.hpp"

namespace orca::hw::link {
namespace {

namespace paths = std::filesystem;

Error no_terminal(int reason, const std::string& name) {
  throw_if_exhausted(reason);
  return fail(Code::unavailable, "the system gives no pseudo terminal: " + std::string(std::strerror(reason)),
              name);
}

}  // namespace

PtyLink::PtyLink(std::string symlink)
    : StreamLink(Kind::terminal, "no driver has the line open any more"), symlink_(std::move(symlink)) {}

PtyLink::~PtyLink() { PtyLink::close(); }

Result<Opening> PtyLink::open() {
  if (is_attached()) return Opening::done;
  Descriptor master(posix_openpt(O_RDWR | O_NOCTTY | O_NONBLOCK | O_CLOEXEC));
  std::array<char, 64> path{};
  if (!master || grantpt(master.number()) != 0 || unlockpt(master.number()) != 0 ||
      ptsname_r(master.number(), path.data(), path.size()) != 0)
    return no_terminal(errno, name());
  // Until a driver has set it, a terminal echoes what arrives and turns byte 3 into a signal.
  if (const Status raw = link::set_line(master.number(), Line{}, name()); !raw.ok()) return raw.error();
  device_ = path.data();
  if (const Status placed = place_symlink(); !placed.ok()) {
    device_.clear();
    return placed.error();
  }
  attach(std::move(master));
  return Opening::done;
}

// The system tells that the other side is closed only if it was open once.
Status PtyLink::await_driver() {
  const Descriptor other_side(::open(device_.c_str(), O_RDWR | O_NOCTTY | O_NONBLOCK | O_CLOEXEC));
  return other_side ? ok() : Status(no_terminal(errno, name()));
}

Status PtyLink::place_symlink() const {
  if (symlink_.empty()) return ok();
  if (const Status trusted = check_output_place(symlink_); !trusted.ok())
    return fail(trusted.error().code, symlink_ + ": " + trusted.error().message, name());
  std::error_code failure;
  const paths::file_status there = paths::symlink_status(symlink_, failure);
  if (paths::exists(there) && !paths::is_symlink(there))
    return fail(Code::already_exists,
                symlink_ + " exists and is no symbolic link; choose another name for the line", name());
  // Renamed into place, so that there is no moment without it.
  const std::string fresh = symlink_ + "." + std::to_string(getpid());
  paths::remove(fresh, failure);
  paths::create_symlink(device_, fresh, failure);
  if (!failure) paths::rename(fresh, symlink_, failure);
  if (!failure) return ok();
  return fail(Code::unavailable, "cannot make the link " + symlink_ + ": " + failure.message(), name());
}

// Another program may have taken the name since.
void PtyLink::remove_symlink() const {
  std::error_code failure;
  if (!symlink_.empty() && paths::read_symlink(symlink_, failure) == device_)
    paths::remove(symlink_, failure);
}

void PtyLink::close() {
  if (!is_attached()) return;
  remove_symlink();
  detach();
  device_.clear();
}

std::string PtyLink::name() const {
  if (!symlink_.empty()) return "pty:" + symlink_;
  return device_.empty() ? "pty" : "pty at " + device_;
}

double PtyLink::byte_time() const {
  const std::optional<Line> set = line();
  return set && set->baud > 0 ? set->byte_time() : 0.0;
}

std::optional<Line> PtyLink::line() const { return is_attached() ? line_of(descriptor()) : std::nullopt; }

}  // namespace orca::hw::link
