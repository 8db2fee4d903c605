// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>

#include "orca/hw/link/byte_link.hpp"

namespace orca::hw::link {

class Connecting;
class Stream;
class TcpListener;

struct TcpOptions {
  std::string host;  ///< A name, an IPv4 or an IPv6 address, without brackets.
  std::uint16_t port = 0;
  /// Longest time that open() may be under way [s], from its first call.
  Duration limit = 3s;
  /// How long open() tries again if nobody listens there yet [s], from its first call: something else may still start.
  Duration patience{0};
};

/// A connection of the network: to a device or device server, or from a client that a listener takes. Each write goes out at once,
/// and another end that does not answer any more is reported as gone after about 5 s.
///
/// All addresses of a host are tried, one after the other. The limit runs on the system's clock, as the network does.
///
/// With a listener, each open() takes the client that has waited longest, and is under way until there is one. When read() or
/// write() reports that the client has gone, close() makes room for the next. Several links of one listener serve several clients.
///
/// Thread contract: one strand.
class TcpLink final : public ByteLink {
 public:
  /// A link that connects to a host.
  explicit TcpLink(TcpOptions options);
  /// A link to clients.
  /// @param listener  outlives the link.
  explicit TcpLink(TcpListener& listener);
  ~TcpLink() override;

  /// @errors  failed_precondition also if the listener is not open.
  [[nodiscard]] Result<Opening> open() override;
  void close() override;
  [[nodiscard]] Result<std::size_t> read(std::span<std::uint8_t> into) override;
  [[nodiscard]] Status write(std::span<const std::uint8_t> bytes) override;
  [[nodiscard]] Status flush() override;
  [[nodiscard]] std::size_t pending() const override;
  void discard_input() override;
  void discard_output() override;
  [[nodiscard]] int descriptor() const override;
  [[nodiscard]] std::string name() const override;

 private:
  [[nodiscard]] Result<Opening> take_client();
  [[nodiscard]] bool goes_on_waiting(const Error& why);

  const TcpOptions options_;
  TcpListener* const listener_ = nullptr;
  std::string peer_;  // the client that was taken last
  const std::unique_ptr<Stream> stream_;
  std::unique_ptr<Connecting> connecting_;  // while open() is under way
  std::optional<TimePoint> waits_since_;    // likewise
};

}  // namespace orca::hw::link
