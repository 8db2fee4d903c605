// SPDX-License-Identifier: GPL-3.0-or-later
// Additional permission: LICENSES/Orca-plugin-exception.txt
#include "page.hpp"

#include <algorithm>
#include <array>
#include <boost/asio/co_spawn.hpp>
#include <boost/asio/detached.hpp>
#include <boost/asio/redirect_error.hpp>
#include <boost/asio/use_awaitable.hpp>
#include <chrono>
#include <fstream>
#include <utility>

#include "answers.hpp"
#include "orca/base/files/own_folder.hpp"
#include "orca/idl/object_type.hpp"

namespace orca::view {
namespace {

namespace asio = boost::asio;
namespace beast = boost::beast;
using asio::awaitable;
using asio::use_awaitable;
using boost::system::error_code;
using nlohmann::json;

constexpr std::chrono::seconds kReport{1};
constexpr std::chrono::seconds kSilence{20};  // after which a page is asked whether it is still there

// A graph that a page has edited is a file for the supervisor.
Result<std::string> keep_graph(const std::string& system, const std::string& text) {
  const Result<OwnFolder> folder = OwnFolder::make();
  if (!folder) return folder.error();
  std::string path = folder->path() + "/" + system + ".view.xml";
  std::ofstream file(path, std::ios::trunc);
  file << text;
  file.close();
  if (!file) return fail(Code::unavailable, "cannot write " + path);
  return path;
}

}  // namespace

// A port at which the page looks.
class Page::Look final : public Onlooker {
 public:
  Look(Page& page, std::uint32_t id, std::string port) : page_(page), id_(id), port_(std::move(port)) {}
  ~Look() { page_.desk_.ports().look_away(port_, *this); }
  Look(const Look&) = delete;
  Look& operator=(const Look&) = delete;

  void begin() { page_.desk_.ports().look(port_, *this); }

  void looking(const std::string& type) override {
    page_.say({{"op", "looking"}, {"id", id_}, {"port", port_}, {"type", type}});
  }
  void see(const std::shared_ptr<const supervisor::Tapped>& passed) override {
    page_.outbox_.add_object(id_, passed);
    page_.wake();
  }
  void blind(const Error& why, bool had_seen) override {
    Page& page = page_;
    const std::uint32_t id = id_;
    page.say({{"op", had_seen ? "lost" : "refused"}, {"id", id}, {"error", why.text()}});
    page.outbox_.end(id);
    page.looks_.erase(id);  // this object
  }

 private:
  Page& page_;
  const std::uint32_t id_;
  const std::string port_;
};

Page::Page(beast::tcp_stream stream, Role role, Desk& desk)
    : socket_(std::move(stream)), role_(role), desk_(desk), bell_(socket_.get_executor()) {
  desk_.join(*this);
}

Page::~Page() {
  looks_.clear();
  desk_.leave(*this);
}

awaitable<void> Page::serve(Request request) {
  const auto self = shared_from_this();
  auto timeout = beast::websocket::stream_base::timeout::suggested(beast::role_type::server);
  timeout.idle_timeout = kSilence;
  timeout.keep_alive_pings = true;
  socket_.set_option(timeout);
  socket_.set_option(beast::websocket::stream_base::decorator([](beast::websocket::response_type& response) {
    response.set(beast::http::field::sec_websocket_protocol, "orca.view.v1");
  }));
  socket_.read_message_max(kLongest);
  socket_.auto_fragment(false);
  error_code error;
  co_await socket_.async_accept(request, asio::redirect_error(use_awaitable, error));
  if (error) co_return;
  beast::get_lowest_layer(socket_).socket().set_option(asio::ip::tcp::no_delay(true), error);
  greet();
  asio::co_spawn(
      socket_.get_executor(), [self] { return self->write_all(); }, asio::detached);
  co_await read_all();
  close();
}

awaitable<void> Page::read_all() {
  beast::flat_buffer buffer;
  while (is_open_) {
    error_code error;
    co_await socket_.async_read(buffer, asio::redirect_error(use_awaitable, error));
    if (error) co_return;
    if (socket_.got_text()) handle(beast::buffers_to_string(buffer.data()));
    buffer.clear();
  }
}

awaitable<void> Page::write_all() {
  while (is_open_) {
    if (co_await write_next()) continue;
    const auto due = outbox_.due();
    bell_.expires_at(due ? *due : Outbox::Moment::max());
    error_code rung;
    co_await bell_.async_wait(asio::redirect_error(use_awaitable, rung));
  }
}

// Returns false if there was nothing to send.
awaitable<bool> Page::write_next() {
  report_drops();
  const std::optional<Frame> frame = outbox_.take(std::chrono::steady_clock::now());
  if (!frame) co_return false;
  error_code error;
  socket_.text(frame->is_text);
  std::array<asio::const_buffer, 2> bytes{asio::buffer(frame->head), asio::const_buffer{}};
  if (frame->passed) bytes[1] = asio::buffer(frame->passed->object);
  co_await socket_.async_write(bytes, asio::redirect_error(use_awaitable, error));
  if (error) close();
  co_return true;
}

void Page::report_drops() {
  const auto now = std::chrono::steady_clock::now();
  if (outbox_.dropped() == reported_ || now < report_due_) return;
  reported_ = outbox_.dropped();
  report_due_ = now + kReport;
  say({{"op", "figures"}, {"dropped", reported_}, {"queued", outbox_.waiting_bytes()}});
}

void Page::say(const json& message) {
  if (!outbox_.add(text_of(message))) return close();
  wake();
}

void Page::greet() {
  if (!outbox_.add(desk_.greeting(role_))) return close();
  wake();
}

void Page::close() {
  if (!is_open_) return;
  is_open_ = false;
  beast::get_lowest_layer(socket_).close();
  wake();
}

void Page::handle(const std::string& text) {
  std::uint32_t id = 0;
  const Result<Wish> wish = read_wish(text, id);
  wish ? handle(*wish) : refuse(id, wish.error().message);
}

void Page::handle(const Wish& wish) {
  switch (wish.op) {
    case Wish::Op::ask: return ask(wish);
    case Wish::Op::cancel: return desk_.leave_log(*this, wish.id);
    case Wish::Op::look: return look(wish);
    case Wish::Op::query:
    case Wish::Op::send: return offer(wish);
    case Wish::Op::types: return say_types();
    case Wish::Op::unlook: outbox_.end(wish.id); looks_.erase(wish.id);
  }
}

void Page::refuse(std::uint32_t id, const std::string& why) {
  say({{"op", "answer"}, {"id", id}, {"ok", false}, {"error", why}});
}

void Page::ask(const Wish& wish) {
  supervisor::Ask ask{wish.command, wish.words, true};
  if (ask.command == "line") return refuse(wish.id, "a page looks at a port with the op look");
  if (role_ == Role::reader && !only_shows(ask.command, !ask.words.empty()))
    return refuse(wish.id, "this page may only look; for orders open the address for operators");
  if (wish.streams && ask.command == "log") return desk_.follow_log(*this, wish.id);
  if (wish.streams) return refuse(wish.id, "only the log can be followed");
  if (std::ranges::find(ask.words, "--follow") != ask.words.end())
    return refuse(wish.id, "for what has no end, ask with \"stream\": true");
  if (!wish.graph.empty()) {
    const Result<std::string> path = keep_graph(desk_.link().system(), wish.graph);
    if (!path) return refuse(wish.id, path.error().text());
    ask.words.insert(ask.words.begin(), *path);
  }
  const auto parts = std::make_shared<AnswerInParts>(wish.id);
  desk_.link().ask(
      std::move(ask), [parts](const supervisor::ControlAnswer& answer) { parts->take(answer); },
      [parts, self = weak_from_this()](const Status& outcome) {
        if (const auto page = self.lock()) page->say(parts->finish(outcome));
      });
}

void Page::look(const Wish& wish) {
  const auto refuse_look = [&](const std::string& why) {
    say({{"op", "refused"}, {"id", wish.id}, {"error", why}});
  };
  if (looks_.size() == kMostLooks)
    return refuse_look("too many looks at a time: " + std::to_string(kMostLooks));
  if (looks_.contains(wish.id)) return refuse_look("each look needs a number of its own");
  constexpr double kNanoseconds = 1e9;
  outbox_.begin(wish.id, std::chrono::nanoseconds(
                             wish.rate > 0.0 ? static_cast<std::int64_t>(kNanoseconds / wish.rate) : 0));
  looks_.emplace(wish.id, std::make_unique<Look>(*this, wish.id, wish.port)).first->second->begin();
}

void Page::offer(const Wish& wish) {
  if (role_ == Role::reader && wish.op == Wish::Op::send)
    return refuse(wish.id, "this page may only look; for orders open the address for operators");
  desk_.ports().offer(
      wish.port, wish.xml,
      [self = weak_from_this(), id = wish.id](const Result<supervisor::OfferOutcome>& outcome) {
        if (const auto page = self.lock()) page->take_outcome(id, outcome);
      });
}

void Page::take_outcome(std::uint32_t id, const Result<supervisor::OfferOutcome>& outcome) {
  if (!outcome) return refuse(id, outcome.error().text());
  if (!outcome->outcome.ok()) return refuse(id, outcome->outcome.error().text());
  json answer{{"op", "answer"}, {"id", id}, {"ok", true}, {"error", ""}};
  if (!outcome->type.empty()) {
    const auto reply = std::make_shared<supervisor::Tapped>();
    reply->object = outcome->object;
    answer["type"] = outcome->type;
    if (!outbox_.add_reply(id, reply)) return close();
  }
  say(answer);
}

void Page::say_types() {
  json types = json::object();
  for (const ObjectType* const type : object_types())
    types[std::string(type->name)] = {
        {"parent", type->parent == nullptr ? "" : std::string(type->parent->name)},
        {"layout", std::string(type->layout)}};
  say({{"op", "types"}, {"types", std::move(types)}});
}

}  // namespace orca::view
