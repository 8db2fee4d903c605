// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <fcntl.h>

#include <filesystem>
#include <string>

#include "link_talk.hpp"
#include "orca/base/descriptor.hpp"
#include "orca/hw/link/pty_link.hpp"
#include "orca/hw/link/serial_link.hpp"
#include "temp_folder.hpp"

namespace orca::test {

/// An adapter that can be plugged in: a pseudo terminal, with a name in a by-id folder of the test's own.
class FakeAdapter {
 public:
  FakeAdapter(const TempFolder& folder, const std::string& id)
      : link_(folder.path() / "serial" / "by-id" / id) {
    std::filesystem::create_directories(link_.parent_path());
  }
  ~FakeAdapter() { unplug(); }
  FakeAdapter(const FakeAdapter&) = delete;
  FakeAdapter& operator=(const FakeAdapter&) = delete;

  void plug_in() {
    must_open(device_);
    std::filesystem::create_symlink(device_.device(), link_);
  }
  void unplug() {
    std::filesystem::remove(link_);
    device_.close();
  }

  /// Returns its device's side.
  [[nodiscard]] hw::link::PtyLink& device() { return device_; }
  [[nodiscard]] std::string id_path() const { return link_.string(); }

 private:
  const std::filesystem::path link_;
  hw::link::PtyLink device_;
};

/// Returns the options for a serial link with the by-id folder of a test.
inline hw::link::SerialOptions serial_at(const TempFolder& folder, const std::string& device,
                                         std::uint32_t baud = 9600) {
  return {device, {baud}, folder.file("serial")};
}

/// Returns the error of opening; fails the test if that succeeds.
inline Error error_of_opening(hw::link::ByteLink& link) {
  const Status opened = hw::link::open_within(link, 5s);
  if (opened.ok()) FAIL("it opens");
  return opened.error();
}

/// Opens a terminal as another program would.
inline Descriptor open_plainly(const std::string& path) {
  return Descriptor(::open(path.c_str(), O_RDWR | O_NOCTTY | O_NONBLOCK | O_CLOEXEC));
}

}  // namespace orca::test
