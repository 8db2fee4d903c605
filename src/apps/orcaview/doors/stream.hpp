// SPDX-License-Identifier: GPL-3.0-or-later
// Additional permission: LICENSES/Orca-plugin-exception.txt
#pragma once

// Boost.Asio 1.74 needs it and does not include it.
#include <utility>

#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/ssl/context.hpp>
#include <boost/beast/core.hpp>
#include <boost/beast/ssl.hpp>
#include <boost/beast/websocket/teardown.hpp>
#include <variant>

namespace orca::view {

/// A connection to a client, plain or with TLS: what Boost.Beast asks of a stream.
///
/// Thread contract: the loop's thread; one read and one write at a time.
class Stream {
 public:
  using Plain = boost::beast::tcp_stream;
  using Secured = boost::beast::ssl_stream<Plain>;
  using next_layer_type = Plain;
  using executor_type = Plain::executor_type;

  explicit Stream(boost::asio::ip::tcp::socket socket)
      : layers_(std::in_place_type<Plain>, std::move(socket)) {}
  /// With TLS: nothing else is called before shake_hands() is done.
  Stream(boost::asio::ip::tcp::socket socket, boost::asio::ssl::context& tls)
      : layers_(std::in_place_type<Secured>, std::move(socket), tls) {}

  /// Returns the connection of TCP.
  [[nodiscard]] next_layer_type& next_layer() {
    Secured* const secured = std::get_if<Secured>(&layers_);
    return secured == nullptr ? std::get<Plain>(layers_) : secured->next_layer();
  }
  [[nodiscard]] executor_type get_executor() { return next_layer().get_executor(); }

  /// Agrees with the client on keys.
  /// @pre  it is one with TLS.
  template <class Handler>
  auto shake_hands(Handler&& handler) {
    return std::get<Secured>(layers_).async_handshake(boost::asio::ssl::stream_base::server,
                                                      std::forward<Handler>(handler));
  }

  template <class Buffers, class Handler>
  auto async_read_some(const Buffers& buffers, Handler&& handler)
      -> decltype(std::declval<Plain&>().async_read_some(buffers, std::forward<Handler>(handler))) {
    if (Secured* const secured = std::get_if<Secured>(&layers_))
      return secured->async_read_some(buffers, std::forward<Handler>(handler));
    return std::get<Plain>(layers_).async_read_some(buffers, std::forward<Handler>(handler));
  }
  template <class Buffers, class Handler>
  auto async_write_some(const Buffers& buffers, Handler&& handler)
      -> decltype(std::declval<Plain&>().async_write_some(buffers, std::forward<Handler>(handler))) {
    if (Secured* const secured = std::get_if<Secured>(&layers_))
      return secured->async_write_some(buffers, std::forward<Handler>(handler));
    return std::get<Plain>(layers_).async_write_some(buffers, std::forward<Handler>(handler));
  }

 private:
  std::variant<Plain, Secured> layers_;
};

/// Ends a connection after a WebSocket has said goodbye, as Boost.Beast asks for. Both sides know then that it is the end, so TLS
/// need not say it again.
inline void teardown(boost::beast::role_type role, Stream& stream, boost::system::error_code& error) {
  using boost::beast::websocket::teardown;
  teardown(role, stream.next_layer(), error);
}
template <class Handler>
void async_teardown(boost::beast::role_type role, Stream& stream, Handler&& handler) {
  using boost::beast::websocket::async_teardown;
  async_teardown(role, stream.next_layer(), std::forward<Handler>(handler));
}

}  // namespace orca::view
