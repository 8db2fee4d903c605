// SPDX-License-Identifier: LGPL-3.0-or-later
#include "device_line.hpp"

#include <fcntl.h>
#include <sys/file.h>

#include <array>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <utility>

#include "orca/base/text.hpp"
#include "orca/hw/link/make_link.hpp"

namespace orca::sim {

DeviceLine::DeviceLine(const std::string& place, std::unique_ptr<emulators::Firmware> firmware)
    : name_(place), firmware_(std::move(firmware)) {
  if (place.starts_with(kListens)) {
    link_ = std::move(hw::link::make_link(place)).value();
    return;
  }
  auto terminal = std::make_unique<hw::link::PtyLink>(hw::link::emulated_path(place));
  terminal_ = terminal.get();
  link_ = std::move(terminal);
}

Status DeviceLine::open() {
  if (terminal_ != nullptr)
    if (Status locked = lock_name(); !locked.ok()) return locked;
  const Result<hw::link::Opening> opened = link_->open();
  if (!opened) return opened.error();
  return terminal_ != nullptr ? terminal_->await_driver() : ok();
}

Status DeviceLine::lock_name() {
  const std::string path = hw::link::emulated_path(name_);
  std::error_code failure;
  const std::filesystem::path folder = std::filesystem::path(path).parent_path();
  if (std::filesystem::create_directories(folder, failure))
    std::filesystem::permissions(folder.parent_path(), std::filesystem::perms::owner_all, failure);
  lock_ = Descriptor(::open((path + ".lock").c_str(), O_RDWR | O_CREAT | O_CLOEXEC | O_NOFOLLOW, 0600));
  if (!lock_)
    return fail(Code::unavailable, "the line " + in_quotes(name_) + " cannot be offered at " + path + ": " +
                                       std::strerror(errno));
  if (flock(lock_.number(), LOCK_EX | LOCK_NB) != 0)
    return fail(Code::already_exists, "the line " + in_quotes(name_) +
                                          " is offered by another system that runs; stop it, or choose "
                                          "another name here and in the driver's device");
  return ok();
}

void DeviceLine::close() {
  link_->close();
  lock_.reset();
}

// While no driver has the line open there is nothing to read, and what the device says is lost.
bool DeviceLine::exchange(TimePoint now) {
  std::array<std::uint8_t, 512> bytes{};
  const auto set = terminal_ != nullptr ? terminal_->line() : std::nullopt;
  const std::uint32_t baud = set ? set->baud : 0;
  auto count = link_->read(bytes);
  firmware_->note_host(static_cast<bool>(count), now);
  for (; count && *count > 0; count = link_->read(bytes)) firmware_->take({bytes.data(), *count}, baud, now);
  const std::vector<std::uint8_t> sent = firmware_->advance(now);
  if (!sent.empty()) (void)link_->write(sent);
  (void)link_->flush();
  return static_cast<bool>(count);
}

}  // namespace orca::sim
