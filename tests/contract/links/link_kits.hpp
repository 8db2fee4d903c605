// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// The links that must fulfil the contract of ByteLink, each with a device at its other end. A new kind is tested by one
/// more kit in ORCA_LINK_KITS.
#pragma once

#include <catch2/catch.hpp>

#include <netinet/in.h>

#include <memory>
#include <string>

#include "link_talk.hpp"
#include "orca/base/steady_clock.hpp"
#include "orca/hw/link/faulty_link.hpp"
#include "orca/hw/link/listen_link.hpp"
#include "orca/hw/link/logged_link.hpp"
#include "orca/hw/link/memory_link.hpp"
#include "orca/hw/link/pty_link.hpp"
#include "orca/hw/link/serial_link.hpp"
#include "orca/hw/link/tcp_link.hpp"
#include "tcp_device.hpp"
#include "temp_folder.hpp"

namespace orca::test {

using hw::link::ByteLink;

/// A link under test and the device at its other end.
struct LinkKit {
  std::unique_ptr<ByteLink> device;
  std::unique_ptr<ByteLink> link;

  /// Opens both ends.
  void connect() {
    (void)device->open();  // a network device is open only when somebody has come
    must_open(*link);
    must_open(*device);
  }
};

/// A serial line; the device is the other side of a pseudo terminal.
struct SerialKit : LinkKit {
  static constexpr bool kHasDescriptor = true;
  /// Whether what the device sent just before it went can still be read. A line that is cut takes its bytes along.
  static constexpr bool kKeepsLastWords = false;
  /// Whether the device gets what the link wrote just before it was closed.
  static constexpr bool kDeliversLastWords = true;
  /// Whether the link knows what waits because the device takes nothing.
  static constexpr bool kTellsPending = true;

  TempFolder folder;

  SerialKit() {
    device = std::make_unique<hw::link::PtyLink>(folder.file("line"));
    link = std::make_unique<hw::link::SerialLink>(
        hw::link::SerialOptions{folder.file("line"), {115200}, folder.file("serial")});
  }
};

/// The device's side of a serial line; the "device" is a driver here.
struct PtyKit : LinkKit {
  static constexpr bool kHasDescriptor = true;
  static constexpr bool kKeepsLastWords = true;
  static constexpr bool kDeliversLastWords = false;
  static constexpr bool kTellsPending = true;

  TempFolder folder;

  PtyKit() {
    link = std::make_unique<hw::link::PtyLink>(folder.file("line"));
    device = std::make_unique<hw::link::SerialLink>(
        hw::link::SerialOptions{folder.file("line"), {115200}, folder.file("serial")});
  }
  void connect() {
    must_open(*link);
    must_open(*device);
  }
};

/// A connection.
template <int kFamily>
struct TcpKit : LinkKit {
  static constexpr bool kHasDescriptor = true;
  static constexpr bool kKeepsLastWords = true;
  static constexpr bool kDeliversLastWords = true;
  static constexpr bool kTellsPending = true;

  TcpKit() {
    auto listener = std::make_unique<TcpDevice>(kFamily);
    const std::string host = kFamily == AF_INET ? "127.0.0.1" : "::1";
    link = std::make_unique<hw::link::TcpLink>(hw::link::TcpOptions{host, listener->port(), 5s});
    device = std::move(listener);
  }
};

/// The device's side of a connection; the "device" is a driver here.
struct ListenKit : LinkKit {
  static constexpr bool kHasDescriptor = true;
  static constexpr bool kKeepsLastWords = true;
  static constexpr bool kDeliversLastWords = true;
  static constexpr bool kTellsPending = true;

  ListenKit() {
    hw::link::ListenOptions options;
    hw::link::ListenLink free_port(options);
    must_open(free_port);
    options.port = free_port.port();
    device = std::make_unique<hw::link::TcpLink>(hw::link::TcpOptions{"127.0.0.1", options.port, 5s});
    link = std::make_unique<hw::link::ListenLink>(options);
  }
  void connect() {
    must_open(*link);
    must_open(*device);
    REQUIRE(soon([this] { return link->flush().ok(); }));  // it has let the driver in
  }
};

/// A line in memory.
struct MemoryKit : LinkKit {
  static constexpr bool kHasDescriptor = false;
  static constexpr bool kKeepsLastWords = true;
  static constexpr bool kDeliversLastWords = true;
  static constexpr bool kTellsPending = false;

  MemoryKit() {
    MemoryEnds ends = make_memory_ends();
    link = std::move(ends.driver);
    device = std::move(ends.device);
  }
};

/// A serial line, with a log.
struct LoggedKit : SerialKit {
  LoggedKit() {
    auto log = hw::link::ByteLog::create({folder.file("log"), std::size_t{1} << 24, steady_now}, "serial");
    link = std::make_unique<hw::link::LoggedLink>(std::move(link), std::move(*log));
  }
};

/// A line in memory on which faults could happen, but none does.
struct FaultlessKit : MemoryKit {
  FaultlessKit() {
    hw::link::FaultPlan plan;
    plan.now = steady_now;
    link = std::make_unique<hw::link::FaultyLink>(std::move(link), std::move(plan));
  }
};

}  // namespace orca::test

#define ORCA_LINK_KITS                                                                                  \
  orca::test::SerialKit, orca::test::PtyKit, orca::test::TcpKit<AF_INET>, orca::test::TcpKit<AF_INET6>, \
      orca::test::ListenKit, orca::test::MemoryKit, orca::test::LoggedKit, orca::test::FaultlessKit
