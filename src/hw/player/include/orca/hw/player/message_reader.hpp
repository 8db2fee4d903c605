// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "orca/base/result.hpp"
#include "orca/hw/player/message.hpp"

namespace orca::hw::player {

/// A message that has arrived.
struct Message {
  Header header;
  std::span<const std::uint8_t> payload;  ///< Valid only during the call that hands it out.
};

/// The messages of one connection, whose bytes arrive in pieces of any size.
///
/// It takes memory only for bytes that have arrived, whatever size a header promises, and keeps that of the longest
/// message. A stream with a wrong header cannot be read any further, since nothing marks the next message: close the
/// connection then. It has no clock: who waits for a banner or an answer needs a time limit.
///
/// Thread contract: not synchronised; one thread.
class MessageReader {
 public:
  enum class Side {
    client,  ///< Reads what a server sends: the banner, then messages.
    server,  ///< Reads what a client sends: messages.
  };
  explicit MessageReader(Side side);

  /// Takes the next bytes and calls sink(const Message&) for each message that they complete, in order. The sink must
  /// not call the reader.
  /// @errors  those of parse_banner() and decode_header(). The same error is returned from then on.
  template <class Sink>
  Status feed(std::span<const std::uint8_t> bytes, Sink&& sink) {
    while (!bytes.empty() && !trouble_) {
      bytes = bytes.subspan(take(bytes));
      if (!is_complete()) continue;
      sink(message());
      await_header();
    }
    return trouble_ ? Status(*trouble_) : ok();
  }

  /// Returns the version of the server, empty until its banner has arrived.
  [[nodiscard]] const std::string& server_version() const { return server_version_; }
  /// Returns the number of bytes that wait for the rest of their message.
  [[nodiscard]] std::size_t waiting() const { return buffer_.size(); }

 private:
  enum class Part { banner, header, payload };

  std::size_t take(std::span<const std::uint8_t> bytes);
  void finish_banner();
  void finish_header();
  void await_header();
  [[nodiscard]] bool is_complete() const { return part_ == Part::payload && buffer_.size() == awaited_; }
  [[nodiscard]] Message message() const { return {header_, std::span(buffer_).subspan(kHeaderSize)}; }

  Part part_;
  std::size_t awaited_;  // bytes that the buffer shall have
  std::vector<std::uint8_t> buffer_;
  Header header_;
  std::string server_version_;
  std::optional<Error> trouble_;
};

}  // namespace orca::hw::player
