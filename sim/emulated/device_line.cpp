// SPDX-License-Identifier: LGPL-3.0-or-later
#include "device_line.hpp"

#include <fcntl.h>
#include <sys/file.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <utility>

#include "orca/base/text.hpp"
#include "orca/hw/link/make_link.hpp"

namespace orca::sim {
namespace {

constexpr std::size_t kMostHosts = 16;

}  // namespace

DeviceLine::DeviceLine(const std::string& place, std::unique_ptr<emulators::Firmware> firmware)
    : name_(place) {
  if (place.starts_with(kListens)) {
    auto link = std::move(hw::link::make_link(place)).value();
    port_ = dynamic_cast<hw::link::ListenLink*>(link.get());
    seats_.push_back({std::move(link), std::move(firmware)});
    return;
  }
  auto terminal = std::make_unique<hw::link::PtyLink>(hw::link::emulated_path(place));
  terminal_ = terminal.get();
  seats_.push_back({std::move(terminal), std::move(firmware)});
}

Status DeviceLine::open() {
  if (terminal_ != nullptr)
    if (Status locked = lock_name(); !locked.ok()) return locked;
  const Result<hw::link::Opening> opened = seats_.front().link->open();
  if (!opened) return opened.error();
  return terminal_ != nullptr ? terminal_->await_driver() : ok();
}

Status DeviceLine::open_in_memory(std::function<void()> ring) {
  const bool listens = name_.starts_with(kListens);
  auto memory = std::make_unique<hw::link::MemoryLink>(
      hw::link::MemoryOptions{.name = listens ? "tcp:" + name_.substr(name_.rfind(':') + 1) : name_,
                              .end = hw::link::MemoryOptions::End::device});
  terminal_ = nullptr;
  port_ = nullptr;
  memory_ = memory.get();
  seats_.front().link = std::move(memory);
  const Result<hw::link::Opening> opened = memory_->open();
  if (!opened) return opened.error();
  memory_->ring_at_input(std::move(ring));
  return ok();
}

Status DeviceLine::lock_name() {
  const std::string path = hw::link::emulated_path(name_);
  if (Status made = hw::link::make_emulated_folder(); !made.ok()) return made;
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

std::string DeviceLine::where() const {
  if (memory_ != nullptr) return "a driver of this run opens it, as " + memory_->name();
  if (terminal_ == nullptr)
    return "it " + name_.substr(0, kListens.size() - 1) + "s at " + name_.substr(kListens.size());
  return "a driver opens it as emulated:" + name_ + ", other programs as " + hw::link::emulated_path(name_);
}

void DeviceLine::close() {
  for (const Seat& seat : seats_) seat.link->close();
  seats_.resize(1);
  lock_.reset();
}

bool DeviceLine::exchange(TimePoint now) {
  const std::uint32_t rate = baud();
  for (Seat& seat : seats_) exchange(seat, rate, now);
  if (port_ != nullptr && std::ranges::all_of(seats_, &Seat::is_taken)) add_seat();
  return std::ranges::any_of(seats_, &Seat::is_taken);
}

// Returns the rate that the driver has set; 0: the line has none.
std::uint32_t DeviceLine::baud() const {
  const auto set = terminal_ != nullptr ? terminal_->line()
                   : memory_ != nullptr ? memory_->line()
                                        : std::nullopt;
  return set ? set->baud : 0;
}

// While no driver has the line open there is nothing to read, and what the device says is lost.
void DeviceLine::exchange(Seat& seat, std::uint32_t baud, TimePoint now) {
  std::array<std::uint8_t, 512> bytes{};
  auto count = seat.link->read(bytes);
  seat.firmware->note_host(static_cast<bool>(count), now);
  for (; count && *count > 0; count = seat.link->read(bytes))
    seat.firmware->take({bytes.data(), *count}, baud, now);
  const std::vector<std::uint8_t> sent = seat.firmware->advance(now);
  if (!sent.empty()) (void)seat.link->write(sent);
  (void)seat.link->flush();
  seat.is_taken = static_cast<bool>(count);
}

void DeviceLine::add_seat() {
  if (seats_.size() == kMostHosts) return;
  if (auto firmware = seats_.front().firmware->for_another_host())
    seats_.push_back({port_->another(), std::move(firmware)});
}

}  // namespace orca::sim
