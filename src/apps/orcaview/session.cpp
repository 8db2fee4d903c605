// SPDX-License-Identifier: GPL-3.0-or-later
// Additional permission: LICENSES/Orca-plugin-exception.txt
#include "session.hpp"

#include <algorithm>
#include <array>
#include <boost/asio/co_spawn.hpp>
#include <boost/asio/detached.hpp>
#include <boost/asio/redirect_error.hpp>
#include <boost/asio/use_awaitable.hpp>
#include <chrono>
#include <utility>

#include "answers.hpp"

namespace orca::view {
namespace {

namespace asio = boost::asio;
namespace beast = boost::beast;
using asio::awaitable;
using asio::use_awaitable;
using boost::system::error_code;
using nlohmann::json;

constexpr std::chrono::seconds kReport{1};
constexpr std::chrono::seconds kSilence{20};  // after which the other end is asked whether it is still there

}  // namespace

// A port at which the other end looks.
class Session::Look final : public Onlooker {
 public:
  Look(Session& session, std::uint32_t id, std::string port)
      : session_(session), id_(id), port_(std::move(port)) {}
  ~Look() { session_.desk_.ports().look_away(port_, *this); }
  Look(const Look&) = delete;
  Look& operator=(const Look&) = delete;

  void begin() { session_.desk_.ports().look(port_, *this); }

  void looking(const std::string& type) override { session_.looking(id_, port_, type); }
  void see(const std::shared_ptr<const supervisor::Tapped>& passed) override {
    session_.outbox_.add_object(id_, passed);
    session_.wake();
  }
  void blind(const Error& why, bool had_seen) override {
    Session& session = session_;
    const std::uint32_t id = id_;
    session.look_away(id);  // this object goes
    session.blind(id, why, had_seen);
  }

 private:
  Session& session_;
  const std::uint32_t id_;
  const std::string port_;
};

Session::Session(Stream stream, Role role, Desk& desk, std::string protocol, std::string via)
    : socket_(std::move(stream)),
      asker_{role, std::move(via)},
      desk_(desk),
      protocol_(std::move(protocol)),
      bell_(socket_.get_executor()) {
  desk_.join(*this);
}

Session::~Session() {
  looks_.clear();
  desk_.leave(*this);
}

awaitable<void> Session::serve(Request request) {
  const auto self = shared_from_this();
  auto timeout = beast::websocket::stream_base::timeout::suggested(beast::role_type::server);
  timeout.idle_timeout = kSilence;
  timeout.keep_alive_pings = true;
  socket_.set_option(timeout);
  socket_.set_option(
      beast::websocket::stream_base::decorator([this](beast::websocket::response_type& response) {
        response.set(beast::http::field::sec_websocket_protocol, protocol_);
      }));
  socket_.read_message_max(kLongest);
  socket_.auto_fragment(false);
  error_code error;
  co_await socket_.async_accept(request, asio::redirect_error(use_awaitable, error));
  if (error) co_return;
  beast::get_lowest_layer(socket_).socket().set_option(asio::ip::tcp::no_delay(true), error);
  system_changed(desk_.link().is_up());
  asio::co_spawn(
      socket_.get_executor(), [self] { return self->write_all(); }, asio::detached);
  co_await read_all();
  close();
}

awaitable<void> Session::read_all() {
  beast::flat_buffer buffer;
  while (is_open_) {
    error_code error;
    co_await socket_.async_read(buffer, asio::redirect_error(use_awaitable, error));
    if (error) co_return;
    const std::string message = beast::buffers_to_string(buffer.data());
    socket_.got_text() ? take_text(message) : take_bytes(message);
    buffer.clear();
  }
}

awaitable<void> Session::write_all() {
  while (is_open_) {
    if (co_await write_next()) continue;
    const auto due = outbox_.due();
    bell_.expires_at(due ? *due : Outbox::Moment::max());
    error_code rung;
    co_await bell_.async_wait(asio::redirect_error(use_awaitable, rung));
  }
}

// Returns false if there was nothing to send.
awaitable<bool> Session::write_next() {
  report_drops();
  if (!outbox_.has_answers()) have_room();
  std::optional<Frame> frame = outbox_.take(std::chrono::steady_clock::now());
  if (!frame) co_return false;
  const std::optional<Packet> packet = frame->passed ? pack(*frame) : Packet{std::move(frame->text)};
  if (!packet) co_return true;
  error_code error;
  socket_.text(frame->kind == Frame::Kind::text);
  const std::vector<std::byte>& body = packet->passed ? packet->passed->object : packet->body;
  const std::array<asio::const_buffer, 2> bytes{asio::buffer(packet->head), asio::buffer(body)};
  co_await socket_.async_write(bytes, asio::redirect_error(use_awaitable, error));
  if (error) close();
  co_return true;
}

void Session::report_drops() {
  const auto now = std::chrono::steady_clock::now();
  if (outbox_.dropped() == reported_ || now < report_due_) return;
  reported_ = outbox_.dropped();
  report_due_ = now + kReport;
  say_drops(reported_, outbox_.waiting_bytes());
}

void Session::say(const json& message) {
  if (!outbox_.add(text_of(message))) return close();
  wake();
}

void Session::say_bytes(std::string bytes) {
  if (!outbox_.add_bytes(std::move(bytes))) return close();
  wake();
}

Status Session::look(std::uint32_t id, const std::string& port, double rate) {
  if (looks_.size() == kMostLooks)
    return fail(Code::unavailable, "too many looks at a time: " + std::to_string(kMostLooks));
  if (looks_.contains(id)) return fail(Code::already_exists, "each look needs a number of its own");
  constexpr double kNanoseconds = 1e9;
  outbox_.begin(id,
                std::chrono::nanoseconds(rate > 0.0 ? static_cast<std::int64_t>(kNanoseconds / rate) : 0));
  looks_.emplace(id, std::make_unique<Look>(*this, id, port)).first->second->begin();
  return ok();
}

bool Session::may_ask() {
  constexpr double kMost = 40.0;
  constexpr double kPerSecond = 20.0;
  const auto now = std::chrono::steady_clock::now();
  const std::chrono::duration<double> since = now - std::exchange(questions_seen_, now);
  questions_left_ = std::min(kMost, questions_left_ + kPerSecond * since.count());
  if (questions_left_ < 1.0) return false;
  questions_left_ -= 1.0;
  return true;
}

void Session::look_away(std::uint32_t id) {
  outbox_.end(id);
  looks_.erase(id);
}

void Session::close() {
  if (!is_open_) return;
  is_open_ = false;
  beast::get_lowest_layer(socket_).close();
  wake();
}

}  // namespace orca::view
