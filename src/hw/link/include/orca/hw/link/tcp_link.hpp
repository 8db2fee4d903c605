// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>

#include "orca/hw/link/stream_link.hpp"

namespace orca::hw::link {

class Connecting;

struct TcpOptions {
  std::string host;  ///< A name, an IPv4 or an IPv6 address, without brackets.
  std::uint16_t port = 0;
  /// Longest time that open() may be under way [s], from its first call.
  Duration limit = 3s;
  /// For how long open() tries again where nothing listens yet [s], from its first call: a server that is being started.
  Duration patience{0};
};

/// A connection to a device or device server in the network. Each write goes out at once, and a device that does not
/// answer any more is told as gone after about 5 s.
///
/// All addresses of a host are tried, one after the other. The limit runs on the system's clock, as the network does.
///
/// Thread contract: one strand.
class TcpLink final : public StreamLink {
 public:
  explicit TcpLink(TcpOptions options);
  ~TcpLink() override;

  [[nodiscard]] Result<Opening> open() override;
  void close() override;
  [[nodiscard]] std::string name() const override;

 private:
  [[nodiscard]] Result<Opening> fail_or_wait(const Error& why);

  const TcpOptions options_;
  std::unique_ptr<Connecting> connecting_;  // while open() is under way
  std::optional<TimePoint> waits_since_;    // for a server that is being started
  TimePoint next_try_{};                    // then
};

}  // namespace orca::hw::link
