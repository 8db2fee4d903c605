// SPDX-License-Identifier: GPL-3.0-or-later
// Additional permission: LICENSES/Orca-plugin-exception.txt
#pragma once

#include "session.hpp"

// after session.hpp, which includes what Boost.Asio lacks
#include <boost/asio/awaitable.hpp>
#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/beast/core.hpp>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>

#include "access.hpp"
#include "batch_door.hpp"
#include "desk.hpp"
#include "orca/base/result.hpp"
#include "web_files.hpp"

namespace orca::view {

/// The server of the page, on this machine only: HTTP/1.1 for its files, a WebSocket for each open page.
///
/// Thread contract: the loop's thread.
class ViewServer {
 public:
  static constexpr std::size_t kMostConnections = 128;

  /// Everything outlives the object, and what it shows does, too.
  ViewServer(boost::asio::io_context& loop, const Tokens& tokens, const WebFiles& files)
      : acceptor_(loop), tokens_(tokens), files_(files) {}

  /// Shows a system.
  void show(Desk& desk) { desk_ = &desk; }
  /// Shows a batch.
  void show(BatchDoor& batch) { batch_ = &batch; }

  /// Begins to listen at 127.0.0.1.
  /// @param port  0: any that is free.
  /// @errors  unavailable if somebody else has it.
  Status listen(std::uint16_t port);
  [[nodiscard]] std::uint16_t port() const { return port_; }

 private:
  boost::asio::awaitable<void> accept_all();
  boost::asio::awaitable<void> serve(boost::asio::ip::tcp::socket socket);
  boost::asio::awaitable<void> serve_requests(boost::asio::ip::tcp::socket socket);
  [[nodiscard]] std::shared_ptr<Session> session_for(const Session::Request& request,
                                                     boost::beast::tcp_stream stream, Role role);
  using Response = boost::beast::http::response<boost::beast::http::string_body>;
  [[nodiscard]] Response file_for(const Session::Request& request) const;
  boost::asio::awaitable<Response> answer_of_batch(const Session::Request& request, Role role);
  [[nodiscard]] std::string refusal(const Session::Request& request) const;
  [[nodiscard]] bool is_for_batch(const Session::Request& request) const;

  boost::asio::ip::tcp::acceptor acceptor_;
  Desk* desk_ = nullptr;        // null: it shows no system
  BatchDoor* batch_ = nullptr;  // null: it shows no batch
  const Tokens& tokens_;
  const WebFiles& files_;
  std::uint16_t port_ = 0;
  std::size_t connections_ = 0;
};

}  // namespace orca::view
