// SPDX-License-Identifier: LGPL-3.0-or-later
#include "orca/hw/emulated_device.hpp"

#include <array>
#include <sstream>

namespace orca::hw {

std::vector<HardwareFault> EmulatedDevice::prepare() {
  std::istringstream words(*lines_);
  std::string kind;
  std::string name;
  std::string more;
  if (!(words >> kind >> name) || words >> more)
    return {{"lines", "write what the device is, and the name of its line: \"owl bench\""}};
  line_ = std::make_unique<link::MemoryLink>(
      link::MemoryOptions{.name = name, .end = link::MemoryOptions::End::device});
  return {};
}

Status EmulatedDevice::open() {
  if (!host().executive().is_virtual())
    return fail(Code::failed_precondition,
                "this emulation works in virtual time only: write --clock virtual");
  const Result<link::Opening> opened = line_->open();
  if (!opened) return opened.error();
  line_->ring_at_input([this] { wake(); });
  due_ = host().now();
  return ok();
}

Status EmulatedDevice::poll() {
  std::array<std::uint8_t, 256> bytes{};
  for (auto count = line_->read(bytes); count && *count > 0; count = line_->read(bytes))
    send(hear(std::span(bytes).first(*count)));
  if (host().now() < due_) return ok();
  due_ = host().now() + period_;
  if (line_->line()) send(speak());
  return ok();
}

// What no driver takes is lost, as on a cable.
void EmulatedDevice::send(const Bytes& bytes) {
  if (!bytes.empty()) (void)line_->write(bytes);
}

}  // namespace orca::hw
