// SPDX-License-Identifier: GPL-3.0-or-later
// Additional permission: LICENSES/Orca-plugin-exception.txt
#pragma once

#include "doors/stream.hpp"

// after stream.hpp, which includes what Boost.Asio lacks
#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/ssl/context.hpp>
#include <cstddef>
#include <cstdint>
#include <list>
#include <optional>

#include "access.hpp"
#include "orca/base/result.hpp"
#include "orca/keys/server_certificate.hpp"

namespace orca::view {

/// An address at which a server takes connections: plain, or with TLS 1.2 or later. What waits at one door takes nothing from those at
/// another one.
///
/// Thread contract: the loop's thread.
class Door {
 public:
  static constexpr std::size_t kMostStrangers = 64;  ///< Connections that have shown no token.
  static constexpr std::size_t kMostSessions = 128;

  /// A plain one, for this machine.
  explicit Door(boost::asio::io_context& loop) : acceptor_(loop) {}

  /// Begins to listen.
  /// @errors  unavailable if somebody else has the port, or the address is not this machine's.
  Status open(const boost::asio::ip::tcp::endpoint& here);
  /// Asks for TLS from now on.
  /// @errors  invalid_argument, if OpenSSL does not take the certificate.
  Status secure(const keys::ServerCertificate& certificate);
  void set_calling(Calling calling) { calling_ = std::move(calling); }

  [[nodiscard]] boost::asio::ip::tcp::acceptor& acceptor() { return acceptor_; }
  [[nodiscard]] const Calling& calling() const { return calling_; }
  [[nodiscard]] std::uint16_t port() const { return port_; }
  [[nodiscard]] bool has_tls() const { return tls_.has_value(); }
  /// Makes a stream of a connection.
  [[nodiscard]] Stream stream_of(boost::asio::ip::tcp::socket socket) {
    return tls_ ? Stream(std::move(socket), *tls_) : Stream(std::move(socket));
  }
  [[nodiscard]] bool is_full() const { return sessions_ >= kMostSessions; }

  /// A connection while it has shown no token. If there are too many, the oldest is closed: so whoever opens connections and says
  /// nothing shuts nobody out.
  class Stranger {
   public:
    Stranger(Door& door, Stream::Plain& connection);
    ~Stranger();
    Stranger(const Stranger&) = delete;
    Stranger& operator=(const Stranger&) = delete;

   private:
    Door& door_;
    Stream::Plain* const connection_;
  };
  /// A connection that is a session.
  class Guest {
   public:
    explicit Guest(Door& door) : door_(door) { ++door_.sessions_; }
    ~Guest() { --door_.sessions_; }
    Guest(const Guest&) = delete;
    Guest& operator=(const Guest&) = delete;

   private:
    Door& door_;
  };

 private:
  boost::asio::ip::tcp::acceptor acceptor_;
  std::optional<boost::asio::ssl::context> tls_;
  Calling calling_;
  std::uint16_t port_ = 0;
  std::list<Stream::Plain*> strangers_;  // the oldest first
  std::size_t sessions_ = 0;
};

}  // namespace orca::view
