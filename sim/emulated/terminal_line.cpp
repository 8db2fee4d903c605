// SPDX-License-Identifier: LGPL-3.0-or-later
#include "terminal_line.hpp"

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

TerminalLine::TerminalLine(std::string name, std::unique_ptr<emulators::Firmware> firmware)
    : name_(std::move(name)),
      path_(hw::link::emulated_path(name_)),
      link_(path_),
      firmware_(std::move(firmware)) {}

Status TerminalLine::open() {
  std::error_code failure;
  const std::filesystem::path folder = std::filesystem::path(path_).parent_path();
  if (std::filesystem::create_directories(folder, failure))
    std::filesystem::permissions(folder.parent_path(), std::filesystem::perms::owner_all, failure);
  lock_ = Descriptor(::open((path_ + ".lock").c_str(), O_RDWR | O_CREAT | O_CLOEXEC | O_NOFOLLOW, 0600));
  if (!lock_)
    return fail(Code::unavailable, "the line " + in_quotes(name_) + " cannot be offered at " + path_ + ": " +
                                       std::strerror(errno));
  if (flock(lock_.number(), LOCK_EX | LOCK_NB) != 0)
    return fail(Code::already_exists, "the line " + in_quotes(name_) +
                                          " is offered by another system that runs; stop it, or choose "
                                          "another name here and in the driver's device");
  const Result<hw::link::Opening> opened = link_.open();
  return opened ? link_.await_driver() : Status(opened.error());
}

void TerminalLine::close() {
  link_.close();
  lock_.reset();
}

// While no driver has the line open there is nothing to read, and what the device says is lost.
bool TerminalLine::exchange(TimePoint now) {
  std::array<std::uint8_t, 512> bytes{};
  const std::uint32_t baud = link_.line() ? link_.line()->baud : 0;
  auto count = link_.read(bytes);
  firmware_->note_host(static_cast<bool>(count), now);
  for (; count && *count > 0; count = link_.read(bytes)) firmware_->take({bytes.data(), *count}, baud, now);
  const std::vector<std::uint8_t> sent = firmware_->advance(now);
  if (!sent.empty()) (void)link_.write(sent);
  (void)link_.flush();
  return static_cast<bool>(count);
}

}  // namespace orca::sim
