// SPDX-License-Identifier: GPL-3.0-or-later
// Additional permission: LICENSES/Orca-plugin-exception.txt
#include "view_server.hpp"

#include <algorithm>
#include <boost/asio/co_spawn.hpp>
#include <boost/asio/detached.hpp>
#include <boost/asio/redirect_error.hpp>
#include <boost/asio/steady_timer.hpp>
#include <boost/asio/use_awaitable.hpp>
#include <boost/beast/websocket/rfc6455.hpp>
#include <chrono>
#include <exception>
#include <memory>
#include <optional>
#include <utility>

#include "foxglove/client.hpp"
#include "orca/base/text.hpp"
#include "page.hpp"

namespace orca::view {
namespace {

namespace asio = boost::asio;
namespace beast = boost::beast;
namespace http = beast::http;
using asio::awaitable;
using asio::use_awaitable;
using asio::ip::tcp;
using boost::system::error_code;

constexpr std::chrono::seconds kPatience{10};     // with whoever sends a request or takes an answer
constexpr std::chrono::milliseconds kPause{200};  // until there may be descriptors again
constexpr std::size_t kLongestHead = std::size_t{16} << 10;

constexpr const char* kOwnPolicy =
    "default-src 'self'; connect-src 'self'; img-src 'self' blob: data:; frame-ancestors 'none'; base-uri "
    "'none'; "
    "form-action 'none'";
// A report has its styles and pictures in itself, and runs nothing.
constexpr const char* kReportPolicy =
    "sandbox; default-src 'none'; style-src 'unsafe-inline'; img-src data:; frame-ancestors 'none'; base-uri "
    "'none'; form-action 'none'";
constexpr const char* kJson = "application/json";

http::response<http::string_body> answer(const Session::Request& request, http::status status,
                                         std::string type, std::string text,
                                         const char* policy = kOwnPolicy) {
  http::response<http::string_body> response(status, request.version());
  response.set(http::field::content_type, type);
  response.set(http::field::cache_control, "no-store");
  response.set("X-Content-Type-Options", "nosniff");
  response.set("Referrer-Policy", "no-referrer");
  response.set("Content-Security-Policy", policy);
  response.keep_alive(request.keep_alive());
  response.body() = std::move(text);
  response.prepare_payload();
  return response;
}

http::response<http::string_body> refuse(const Session::Request& request, http::status status,
                                         std::string why) {
  return answer(request, status, "text/plain; charset=utf-8", std::move(why) + "\n");
}

std::string_view view_of(boost::beast::string_view text) { return {text.data(), text.size()}; }

}  // namespace

Status ViewServer::listen(std::uint16_t port) {
  if (const Status is_open = near_.open({asio::ip::make_address("127.0.0.1"), port}); !is_open.ok())
    return fail(Code::unavailable, is_open.error().message + "; take another port, or 0 for any: --port 0");
  begin(near_);
  return ok();
}

Status ViewServer::listen(const Listening& there, const keys::ServerCertificate& certificate) {
  constexpr std::uint16_t kUsualPort = 8443;
  if (const Status secured = far_.secure(certificate); !secured.ok()) return secured;
  Status is_open = far_.open({there.address, there.port.value_or(kUsualPort)});
  if (!is_open.ok() && !there.port) is_open = far_.open({there.address, 0});
  if (!is_open.ok())
    return fail(Code::unavailable, is_open.error().message +
                                       "; choose another port, or 0 for any, or another "
                                       "address of this machine: --listen ADDRESS:0");
  const std::string address =
      there.address.is_v6() ? "[" + there.address.to_string() + "]" : there.address.to_string();
  Calling calling{"https", certificate.names};
  if (!there.address.is_unspecified()) calling.names.push_back(address);
  const auto name =
      std::ranges::find_if(calling.names, [](const auto& each) { return !each.starts_with('*'); });
  const std::string& shown = name == calling.names.end() ? address : *name;
  far_address_ = "https://" + shown + ":" + std::to_string(far_.port()) + "/";
  far_.set_calling(std::move(calling));
  begin(far_);
  return ok();
}

void ViewServer::begin(Door& door) {
  asio::co_spawn(door.acceptor().get_executor(), accept_all(door), asio::detached);
}

awaitable<void> ViewServer::accept_all(Door& door) {
  for (;;) {
    error_code error;
    tcp::socket socket = co_await door.acceptor().async_accept(asio::redirect_error(use_awaitable, error));
    if (error == asio::error::operation_aborted) co_return;
    if (error) {  // no descriptors are left
      asio::steady_timer pause(door.acceptor().get_executor(), kPause);
      co_await pause.async_wait(asio::redirect_error(use_awaitable, error));
      continue;
    }
    asio::co_spawn(door.acceptor().get_executor(), serve(door, std::move(socket)), asio::detached);
  }
}

awaitable<void> ViewServer::serve(Door& door, tcp::socket socket) {
  try {
    co_await serve_requests(door, std::move(socket));
  } catch (const std::exception&) {  // such as lack of memory: this connection ends, the others go on
  }
}

awaitable<void> ViewServer::serve_requests(Door& door, tcp::socket socket) {
  Stream stream = door.stream_of(std::move(socket));
  std::optional<Door::Stranger> stranger(std::in_place, door, stream.next_layer());
  error_code error;
  stream.next_layer().expires_after(kPatience);
  if (door.has_tls()) co_await stream.shake_hands(asio::redirect_error(use_awaitable, error));
  if (error) co_return;
  beast::flat_buffer buffer;
  for (;;) {
    http::request_parser<http::string_body> parser;
    parser.header_limit(kLongestHead);
    parser.body_limit(0);
    stream.next_layer().expires_after(kPatience);
    co_await http::async_read(stream, buffer, parser, asio::redirect_error(use_awaitable, error));
    if (error) co_return;
    Session::Request request = parser.release();
    const std::string why = refusal(request, door);
    const std::string_view target = view_of(request.target());
    const std::optional<Role> role = tokens_.role_of(query_value(target, "token"));
    if (why.empty() && desk_ != nullptr && beast::websocket::is_upgrade(request)) {
      if (door.is_full()) co_return;
      const Door::Guest guest(door);
      stranger.reset();
      stream.next_layer().expires_never();
      const std::shared_ptr<Session> session = session_for(request, std::move(stream), *role);
      co_return co_await session->serve(std::move(request));
    }
    Response response = why.empty() ? Response() : refuse(request, http::status::forbidden, why);
    if (why.empty() && is_for_batch(request)) {
      response = co_await answer_of_batch(request, *role);
    } else if (why.empty()) {
      response = file_for(request);
    }
    co_await http::async_write(stream, response, asio::redirect_error(use_awaitable, error));
    if (error || !response.keep_alive()) co_return;
  }
}

ViewServer::Response ViewServer::file_for(const Session::Request& request) const {
  std::optional<WebFile> file = files_.find(view_of(request.target()));
  return file ? answer(request, http::status::ok, std::move(file->type), std::move(file->text))
              : refuse(request, http::status::not_found, "there is no such file");
}

awaitable<ViewServer::Response> ViewServer::answer_of_batch(const Session::Request& request, Role role) {
  const bool is_post = request.method() == http::verb::post;
  BatchDoor::Reply reply = co_await batch_->answer(std::string(view_of(request.target())), is_post, role);
  co_return answer(request, static_cast<http::status>(reply.status),
                   reply.is_report ? "text/html; charset=utf-8" : kJson, std::move(reply.text),
                   reply.is_report ? kReportPolicy : kOwnPolicy);
}

// Viewers that speak several protocols get the first that they share with this server.
std::shared_ptr<Session> ViewServer::session_for(const Session::Request& request, Stream stream, Role role) {
  const std::string offered(view_of(request[http::field::sec_websocket_protocol]));
  for (const char* const protocol : FoxgloveClient::kProtocols)
    if (http::token_list(offered).exists(protocol))
      return std::make_shared<FoxgloveClient>(std::move(stream), role, *desk_, protocol);
  return std::make_shared<Page>(std::move(stream), role, *desk_);
}

// These need the token, as a system does.
bool ViewServer::is_for_batch(const Session::Request& request) const {
  const bool is_known = request.method() == http::verb::get || request.method() == http::verb::post;
  return batch_ != nullptr && is_known && view_of(request.target()).starts_with("/batch/") &&
         !beast::websocket::is_upgrade(request);
}

// Returns why a request is refused; empty: it is not.
std::string ViewServer::refusal(const Session::Request& request, const Door& door) const {
  const std::string_view host = view_of(request[http::field::host]);
  if (!is_own_host(host, door.calling()))
    return "this server is " + listed(door.calling().names) + ", by no other name";
  if (!is_own_origin(view_of(request[http::field::origin]), host, door.calling()))
    return "pages of other servers have no access";
  const bool is_for_batch = this->is_for_batch(request);
  if (request.method() != http::verb::get && !is_for_batch) return "this server knows GET only";
  if (!beast::websocket::is_upgrade(request) && !is_for_batch) return "";
  if (!tokens_.role_of(query_value(view_of(request.target()), "token")))
    return "the token is wrong; open the address that orcaview has printed";
  return "";
}

}  // namespace orca::view
