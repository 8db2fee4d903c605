// SPDX-License-Identifier: GPL-3.0-or-later
// Additional permission: LICENSES/Orca-plugin-exception.txt
#pragma once

#include "session.hpp"

// after session.hpp, which includes what Boost.Asio lacks
#include <boost/asio/awaitable.hpp>
#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <cstdint>
#include <memory>
#include <string>

#include "access.hpp"
#include "batch_door.hpp"
#include "desk.hpp"
#include "doors/door.hpp"
#include "doors/listening.hpp"
#include "orca/base/result.hpp"
#include "web_files.hpp"

namespace orca::view {

/// The server of the page: HTTP/1.1 for its files, a WebSocket for each open page. It has a plain door for this machine only, and one
/// with TLS for others if that is wished.
///
/// Thread contract: the loop's thread.
class ViewServer {
 public:
  /// Everything outlives the object, and what it shows does, too.
  ViewServer(boost::asio::io_context& loop, const Tokens& tokens, const WebFiles& files)
      : near_(loop), far_(loop), tokens_(tokens), files_(files) {}

  /// Shows a system.
  void show(Desk& desk) { desk_ = &desk; }
  /// Shows a batch.
  void show(BatchDoor& batch) { batch_ = &batch; }

  /// Begins to listen at 127.0.0.1.
  /// @param port  0: any that is free.
  /// @errors  unavailable if somebody else has it.
  Status listen(std::uint16_t port);
  [[nodiscard]] std::uint16_t port() const { return near_.port(); }

  /// Begins to listen with TLS at another address, where it is called by the certificate's names and by that address. Without a port
  /// it is 8443, or any that is free if somebody else has that.
  /// @errors  unavailable if the port is somebody else's, or the address is not this machine's; invalid_argument if the
  ///          certificate cannot be used.
  Status listen(const Listening& there, const keys::ServerCertificate& certificate);
  /// Returns the beginning of addresses there, such as "https://10.0.0.7:8443/"; empty: it listens on this machine only.
  [[nodiscard]] const std::string& far_address() const { return far_address_; }

 private:
  void begin(Door& door);
  boost::asio::awaitable<void> accept_all(Door& door);
  boost::asio::awaitable<void> serve(Door& door, boost::asio::ip::tcp::socket socket);
  boost::asio::awaitable<void> serve_requests(Door& door, boost::asio::ip::tcp::socket socket);
  [[nodiscard]] std::shared_ptr<Session> session_for(const Session::Request& request, Stream stream,
                                                     Role role);
  using Response = boost::beast::http::response<boost::beast::http::string_body>;
  [[nodiscard]] Response file_for(const Session::Request& request) const;
  boost::asio::awaitable<Response> answer_of_batch(const Session::Request& request, Role role);
  [[nodiscard]] std::string refusal(const Session::Request& request, const Door& door) const;
  [[nodiscard]] bool is_for_batch(const Session::Request& request) const;

  Door near_;
  Door far_;
  std::string far_address_;
  Desk* desk_ = nullptr;        // null: it shows no system
  BatchDoor* batch_ = nullptr;  // null: it shows no batch
  const Tokens& tokens_;
  const WebFiles& files_;
};

}  // namespace orca::view
