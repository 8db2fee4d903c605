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
#include <functional>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "access.hpp"
#include "doors/stream.hpp"
#include "outbox.hpp"

namespace orca::view {

/// The bytes of a frame that carries an object.
struct Packet {
  std::string head;
  std::vector<std::byte> body{};                       ///< Follows the head,
  std::shared_ptr<const supervisor::Tapped> passed{};  ///< or, if there is one, its object does.
};

/// A WebSocket to a page, or to another viewer. It sends the objects of the ports at which the other end looks. One that does
/// not read loses objects; one that does not even take answers is closed.
///
/// Thread contract: the loop's thread.
class Session : public std::enable_shared_from_this<Session> {
 public:
  using Socket = boost::beast::websocket::stream<Stream>;
  using Request = boost::beast::http::request<boost::beast::http::string_body>;
  static constexpr std::size_t kLongest = std::size_t{1} << 20;  ///< [bytes] of a message.
  static constexpr std::size_t kMostLooks = 256;                 ///< At a time.

  virtual ~Session();
  Session(const Session&) = delete;
  Session& operator=(const Session&) = delete;

  /// Serves the other end until it is closed.
  boost::asio::awaitable<void> serve(Request request);

  /// Learns that the system is there, or there again; or that it is gone. The first time at the beginning.
  virtual void system_changed(bool is_up) = 0;
  /// Learns that the time of a recording was set, so that what it has seen, or has not sent yet, holds no more.
  virtual void time_moved() { outbox_.forget_objects(); }
  /// Takes a line of the log that it follows.
  /// @param id  of the wish.
  virtual void hear(std::uint32_t id, const nlohmann::json& line) = 0;

 protected:
  /// @param protocol  the sub-protocol that was chosen.
  /// @param via       what it is, as in supervisor::Ask.
  Session(Stream stream, Role role, Desk& desk, std::string protocol, std::string via);

  virtual void take_text(const std::string& text) = 0;
  virtual void take_bytes(const std::string& bytes) = 0;
  /// Returns what is to be sent for an object; nothing: it is left out.
  virtual std::optional<Packet> pack(const Frame& frame) = 0;
  /// A look has begun.
  virtual void looking(std::uint32_t id, const std::string& port, const std::string& type) = 0;
  /// A look could not begin, or has ended.
  virtual void blind(std::uint32_t id, const Error& why, bool had_seen) = 0;

  /// Learns that no answer waits, so that there is room for one of any size.
  virtual void have_room() {}

  /// Says that objects were dropped because the other end was slow.
  /// @param dropped  so far.
  /// @param waiting  [bytes] that wait.
  virtual void say_drops(std::uint64_t dropped, std::size_t waiting) = 0;

  /// Sends a message.
  void say(const nlohmann::json& message);
  /// Sends a message that carries bytes.
  void say_bytes(std::string bytes);
  /// Lets what waits be sent.
  void wake() { bell_.cancel(); }
  /// Begins to look at a port.
  /// @param rate  [1/s] Most objects; 0: all.
  /// @errors  unavailable: too many looks; already_exists: the number is taken. Other errors come as blind().
  Status look(std::uint32_t id, const std::string& port, double rate);
  void look_away(std::uint32_t id);

  /// Returns whether one more question is within the budget of this session: 40 at once, 20 a second in the long run.
  [[nodiscard]] bool may_ask();

  [[nodiscard]] Role role() const { return asker_.most; }
  [[nodiscard]] const Ports::Asker& asker() const { return asker_; }
  /// Returns a question as it is asked for the other end: with its role, and how it has come.
  [[nodiscard]] supervisor::Ask for_it(supervisor::Ask ask) const {
    ask.most = asker_.most;
    ask.via = asker_.via;
    return ask;
  }
  [[nodiscard]] Desk& desk() { return desk_; }

 private:
  class Look;
  boost::asio::awaitable<void> read_all();
  boost::asio::awaitable<void> write_all();
  boost::asio::awaitable<bool> write_next();
  void report_drops();
  void close();

  Socket socket_;
  const Ports::Asker asker_;
  Desk& desk_;
  const std::string protocol_;
  Outbox outbox_;
  std::map<std::uint32_t, std::unique_ptr<Look>> looks_;
  boost::asio::steady_timer bell_;  // cancelled when there is something to send
  double questions_left_ = 40.0;
  Outbox::Moment questions_seen_{};
  bool is_open_ = true;
  std::uint64_t reported_ = 0;  // drops
  Outbox::Moment report_due_{};
};

}  // namespace orca::view
