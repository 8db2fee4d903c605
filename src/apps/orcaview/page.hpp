// SPDX-License-Identifier: GPL-3.0-or-later
// Additional permission: LICENSES/Orca-plugin-exception.txt
#pragma once

#include "desk.hpp"

// after desk.hpp, which includes what Boost.Asio lacks
#include <boost/asio/awaitable.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/steady_timer.hpp>
#include <boost/beast/core.hpp>
#include <boost/beast/http.hpp>
#include <boost/beast/websocket.hpp>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>

#include "access.hpp"
#include "outbox.hpp"
#include "wish.hpp"

namespace orca::view {

/// One page that is open in a browser, over its WebSocket. It answers what the page asks, and sends the objects that the page
/// looks at. A page that sends nonsense gets an error for it; one that does not read is closed.
///
/// Thread contract: the loop's thread.
class Page : public std::enable_shared_from_this<Page> {
 public:
  using Socket = boost::beast::websocket::stream<boost::beast::tcp_stream>;
  using Request = boost::beast::http::request<boost::beast::http::string_body>;
  static constexpr std::size_t kLongest = std::size_t{1} << 20;  ///< [bytes] of a message from a page.
  static constexpr std::size_t kMostLooks = 256;                 ///< At a time.

  Page(boost::beast::tcp_stream stream, Role role, Desk& desk);
  ~Page();
  Page(const Page&) = delete;
  Page& operator=(const Page&) = delete;

  /// Serves the page until it is closed.
  boost::asio::awaitable<void> serve(Request request);

  /// Sends a message.
  void say(const nlohmann::json& message);
  /// Says hello: the system is there, or there again.
  void greet();

 private:
  class Look;
  boost::asio::awaitable<void> read_all();
  boost::asio::awaitable<void> write_all();
  boost::asio::awaitable<bool> write_next();
  void handle(const std::string& text);
  void handle(const Wish& wish);
  void ask(const Wish& wish);
  void look(const Wish& wish);
  void offer(const Wish& wish);
  void take_outcome(std::uint32_t id, const Result<supervisor::OfferOutcome>& outcome);
  void say_types();
  void refuse(std::uint32_t id, const std::string& why);
  void report_drops();
  void wake() { bell_.cancel(); }
  void close();

  Socket socket_;
  const Role role_;
  Desk& desk_;
  Outbox outbox_;
  std::map<std::uint32_t, std::unique_ptr<Look>> looks_;
  boost::asio::steady_timer bell_;  // cancelled when there is something to send
  bool is_open_ = true;
  std::uint64_t reported_ = 0;  // drops
  Outbox::Moment report_due_{};
};

}  // namespace orca::view
