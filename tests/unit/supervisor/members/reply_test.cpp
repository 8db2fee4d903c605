// SPDX-License-Identifier: GPL-3.0-or-later
// The answer to a client of the control socket, whatever the client does with it.
#include "members/reply.hpp"

#include <catch2/catch.hpp>

#include <memory>
#include <string>
#include <variant>
#include <vector>

using namespace orca;
using namespace orca::supervisor;

namespace {

// A client that reads only when it is asked to.
class LazyClient {
 public:
  explicit LazyClient(std::size_t bound = Channel::kDefaultBound) {
    SocketPair pair = std::move(make_socket_pair()).value();
    server_ = std::make_shared<Channel>(std::move(pair.supervisor), bound);
    client_.emplace(std::move(pair.host));
  }
  [[nodiscard]] const std::shared_ptr<Channel>& server() const { return server_; }
  void hang_up() { server_.reset(); }

  // Reads what there is.
  void read_some(std::vector<std::string>& texts) {
    for (std::optional<Message> message = next(); message; message = next())
      texts.push_back(std::get<TextAnswer>(decode_answer(std::move(*message)).value()).text);
  }

  // Reads until nothing more comes, and returns why.
  Error end_of_connection() {
    for (;;)
      if (const Result<Message> message = client_->wait_for_message(1s); !message) return message.error();
  }

  // Returns the texts of an answer, and its end.
  Status read(std::vector<std::string>& texts) {
    for (;;) {
      (void)server_->flush();
      Message message = std::move(client_->wait_for_message(1s)).value();
      CHECK(message.request == 7);
      ControlAnswer answer = std::move(decode_answer(std::move(message))).value();
      if (const auto* const end = std::get_if<EndAnswer>(&answer)) return end->outcome;
      texts.push_back(std::get<TextAnswer>(answer).text);
    }
  }

 private:
  std::optional<Message> next() {
    (void)server_->flush();
    return std::move(client_->receive()).value();
  }

  std::shared_ptr<Channel> server_;
  std::optional<Channel> client_;
};

}  // namespace

TEST_CASE("an answer ends well unless it was refused, and with the first error that refused it",
          "[supervisor][reply]") {
  LazyClient client;
  std::vector<std::string> texts;
  {
    Reply reply(client.server(), 7, true);
    CHECK(reply.as_json());
    CHECK_FALSE(reply.is_in_vain());
    reply.add("one");
    reply.add("two");
  }
  CHECK(client.read(texts).ok());
  CHECK(texts == std::vector<std::string>{"one", "two"});
  {
    Reply reply(client.server(), 7, false);
    CHECK_FALSE(reply.as_json());
    reply.refuse(fail(Code::not_found, "there is none"));
    reply.refuse(fail(Code::internal, "and more"));
  }
  const Status end = client.read(texts);
  REQUIRE_FALSE(end.ok());
  CHECK(end.error().code == Code::not_found);
  CHECK(end.error().message == "there is none");
}

TEST_CASE("what a client does not read is left out and counted, until somebody asks how much it was",
          "[supervisor][reply]") {
  LazyClient client(0);
  Reply reply(client.server(), 7, false);
  CHECK(reply.take_left_out() == 0);
  constexpr int kParts = 200;
  for (int i = 0; i < kParts; ++i) reply.add(std::string(32'000, 'x'));
  const std::uint64_t left_out = reply.take_left_out();
  CHECK(left_out > 0);
  CHECK(left_out < kParts);
  CHECK(reply.take_left_out() == 0);
  reply.add(std::string(32'000, 'x'));
  CHECK(reply.take_left_out() == 1);
}

TEST_CASE("a client that does not read the end of its answer learns that nothing more comes",
          "[supervisor][reply]") {
  LazyClient client(0);
  {
    Reply reply(client.server(), 7, false);
    while (reply.take_left_out() == 0) reply.add(std::string(32'000, 'x'));
  }
  CHECK(client.end_of_connection().code == Code::unavailable);
}

TEST_CASE("an answer that is not complete says so at its end", "[supervisor][reply]") {
  LazyClient client(0);
  std::vector<std::string> texts;
  auto reply = std::make_unique<Reply>(client.server(), 7, false);
  while (reply->take_left_out() == 0) reply->add(std::string(32'000, 'x'));
  reply->add(std::string(32'000, 'x'));
  client.read_some(texts);  // too late for the last two
  reply.reset();
  const Status end = client.read(texts);
  REQUIRE_FALSE(end.ok());
  CHECK(end.error().message.find("left out: 1") != std::string::npos);
}

TEST_CASE("an answer to a client that has gone is in vain and costs nothing", "[supervisor][reply]") {
  LazyClient client;
  Reply reply(client.server(), 7, false);
  client.hang_up();
  CHECK(reply.is_in_vain());
  reply.add("to nobody");
  CHECK(reply.take_left_out() == 0);
}
