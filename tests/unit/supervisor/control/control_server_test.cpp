// SPDX-License-Identifier: GPL-3.0-or-later
// The supervisor's side of the socket, with clients in the same process.
#include "control/control_server.hpp"

#include <sys/resource.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <catch2/catch.hpp>
#include <cstdlib>
#include <filesystem>

#include "orca/supervisor/channel.hpp"

using namespace orca;
using namespace orca::supervisor;

namespace {

constexpr Moment kServerStart{100s};
constexpr Duration kAnswerLimit = 2s;

// A server whose system answers "ps" with one record, and a number of others with nothing.
class Served {
 public:
  Served() {
    char path[] = "/tmp/orca-test-XXXXXX";
    REQUIRE(mkdtemp(path) != nullptr);
    folder_ = path;
    setenv("XDG_RUNTIME_DIR", path, 1);
    server_.emplace(std::move(ControlSocket::open("system")).value(),
                    [this](const Ask& ask, const Asker&, const ReplyPtr& reply) { answer(ask, reply); });
  }
  ~Served() {
    server_.reset();
    unsetenv("XDG_RUNTIME_DIR");
    std::filesystem::remove_all(folder_);
  }
  Served(const Served&) = delete;
  Served& operator=(const Served&) = delete;

  [[nodiscard]] Descriptor connect() const { return std::move(connect_to_system("system")).value(); }
  void serve(int times = 1, Moment now = kServerStart) {
    for (int i = 0; i < times; ++i) server_->serve(now);
  }
  [[nodiscard]] std::size_t clients() const { return server_->clients(); }
  // Returns whether it waits for something, as poll() sees it.
  [[nodiscard]] bool has_something_to_do() const {
    std::vector<pollfd> all;
    server_->add_to(all);
    return poll(all.data(), all.size(), 0) > 0;
  }
  std::vector<ReplyPtr> kept;  // replies to "wait"
  int asked = 0;

 private:
  void answer(const Ask& ask, const ReplyPtr& reply) {
    ++asked;
    if (ask.command == "wait") kept.push_back(reply);
    if (ask.command == "ps") reply->add(Record{{"name", "goto"}});
    if (ask.command == "long") reply->add(std::string(100'000, 'x'));
    if (ask.command == "no") reply->refuse(fail(Code::not_found, "no"));
  }

  std::filesystem::path folder_;
  std::optional<ControlServer> server_;
};

ControlAnswer next(Channel& client) {
  return std::move(decode_answer(std::move(client.wait_for_message(kAnswerLimit)).value())).value();
}

}  // namespace

TEST_CASE("a client gets what it asks for, and the end of it", "[supervisor][control]") {
  Served system;
  Channel client(system.connect());
  REQUIRE(client.post(encode(Ask{"ps", {}, false}, 1)).ok());
  system.serve();
  CHECK(std::get<RecordAnswer>(next(client)).record.at(0).value == "goto");
  CHECK(std::get<EndAnswer>(next(client)).outcome.ok());
  REQUIRE(client.post(encode(Ask{"no", {}, false}, 2)).ok());
  system.serve();
  CHECK(std::get<EndAnswer>(next(client)).outcome.error().code == Code::not_found);
}

TEST_CASE("an answer that comes later ends when nobody holds the reply any more", "[supervisor][control]") {
  Served system;
  Channel client(system.connect());
  REQUIRE(client.post(encode(Ask{"wait", {}, false}, 1)).ok());
  system.serve();
  CHECK(client.wait_for_message(50ms).error().code == Code::deadline_exceeded);
  REQUIRE(system.kept.size() == 1);
  CHECK_FALSE(system.kept.front()->is_in_vain());
  system.kept.clear();
  CHECK(std::get<EndAnswer>(next(client)).outcome.ok());
}

TEST_CASE("a client that has gone is forgotten, and what is still said to it is in vain",
          "[supervisor][control]") {
  Served system;
  {
    Channel client(system.connect());
    REQUIRE(client.post(encode(Ask{"wait", {}, false}, 1)).ok());
    system.serve();
    CHECK(system.clients() == 1);
  }
  system.serve();
  CHECK(system.clients() == 0);
  CHECK(system.kept.front()->is_in_vain());
  system.kept.front()->add(Record{{"name", "late"}});
}

TEST_CASE("rubbish and words of another kind cut a client off", "[supervisor][control]") {
  Served system;
  const Descriptor rubbish = system.connect();
  REQUIRE(send(rubbish.number(), "rubbish", 7, 0) == 7);
  Channel stranger(system.connect());
  REQUIRE(stranger.post(encode(LineWord(Offer{}))).ok());
  Channel talker(system.connect());
  REQUIRE(talker.post(encode(Ask{std::string(ControlServer::kLongestAsk, 'x'), {}, false}, 1)).ok());
  system.serve(3);
  CHECK(system.clients() == 0);
  CHECK(system.asked == 0);
}

TEST_CASE("a client that asks without end is cut off, one that asks now and then is not",
          "[supervisor][control]") {
  Served system;
  Channel modest(system.connect());
  for (int second = 0; second < 5; ++second) {
    for (int i = 0; i < ControlServer::kMostAsks; ++i)
      REQUIRE(modest.post(encode(Ask{"", {}, false}, 1)).ok());
    system.serve(50, kServerStart + Duration(1s) * second);
  }
  CHECK(system.clients() == 1);
  CHECK(system.asked == 5 * ControlServer::kMostAsks);
  for (int i = 0; i <= ControlServer::kMostAsks; ++i)
    REQUIRE(modest.post(encode(Ask{"", {}, false}, 1)).ok());
  system.serve(50, kServerStart + 10s);
  CHECK(system.clients() == 0);
}

TEST_CASE("of what a client does not read, little is kept", "[supervisor][control]") {
  Served system;
  Channel client(system.connect());
  REQUIRE(client.post(encode(Ask{"wait", {}, false}, 1)).ok());
  system.serve();
  const ReplyPtr reply = system.kept.front();
  for (int i = 0; i < 1000; ++i) reply->add(std::string(10'000, 'x'));
  CHECK(reply->take_left_out() > 800);
  CHECK(reply->take_left_out() == 0);
  CHECK(system.clients() == 1);
}

TEST_CASE("beyond the greatest number of clients the oldest has to go", "[supervisor][control]") {
  Served system;
  std::vector<Descriptor> crowd;
  for (std::size_t i = 0; i < 2 * ControlServer::kMostClients; ++i) {
    crowd.push_back(system.connect());
    system.serve();
  }
  CHECK(system.clients() == ControlServer::kMostClients);
  Channel last(std::move(crowd.back()));
  REQUIRE(last.post(encode(Ask{"ps", {}, false}, 1)).ok());
  system.serve();
  CHECK(std::holds_alternative<RecordAnswer>(next(last)));
}

TEST_CASE("a client that waits while there are no descriptors left keeps nobody busy, and is served later",
          "[supervisor][control]") {
  Served system;
  Channel client(system.connect());
  CHECK(system.has_something_to_do());
  rlimit before{};
  getrlimit(RLIMIT_NOFILE, &before);
  const rlimit none{3, before.rlim_max};
  setrlimit(RLIMIT_NOFILE, &none);
  system.serve();
  CHECK(system.clients() == 0);
  const bool is_busy = system.has_something_to_do();
  setrlimit(RLIMIT_NOFILE, &before);
  CHECK_FALSE(is_busy);
  system.serve(1, kServerStart + 199ms);
  CHECK(system.clients() == 0);
  system.serve(1, kServerStart + 200ms);
  CHECK(system.clients() == 1);
  REQUIRE(client.post(encode(Ask{"ps", {}, false}, 1)).ok());
  CHECK(system.has_something_to_do());
  system.serve(1, kServerStart + 1s);
  CHECK(system.asked == 1);
}

TEST_CASE("a process with many connections loses its own, and none of another that has just come",
          "[supervisor][control]") {
  Served system;
  std::vector<Descriptor> crowd;
  const auto flood = [&](std::size_t count) {
    for (std::size_t i = 0; i < count; ++i) {
      crowd.push_back(system.connect());
      system.serve();
    }
  };
  flood(ControlServer::kMostClients);
  int ready[2] = {-1, -1};
  int go[2] = {-1, -1};
  REQUIRE(pipe(ready) == 0);
  REQUIRE(pipe(go) == 0);
  const pid_t other = fork();
  if (other == 0) {
    Channel client(system.connect());
    char byte = 'x';
    (void)!write(ready[1], &byte, 1);
    (void)!read(go[0], &byte, 1);
    (void)client.post(encode(Ask{"no", {}, false}, 1));
    const Result<Message> answer = client.wait_for_message(kAnswerLimit);
    _exit(answer ? 0 : 1);
  }
  char byte = 0;
  REQUIRE(read(ready[0], &byte, 1) == 1);
  flood(3 * ControlServer::kMostClients);
  REQUIRE(write(go[1], &byte, 1) == 1);
  int status = -1;
  for (int i = 0; i < 2000 && waitpid(other, &status, WNOHANG) == 0; ++i) {
    system.serve();
    usleep(1000);
  }
  CHECK(status == 0);
  CHECK(system.asked == 1);
  for (const int one : {ready[0], ready[1], go[0], go[1]}) close(one);
}

TEST_CASE("a client that waits for an answer stays, while others come and ask nothing",
          "[supervisor][control]") {
  Served system;
  Channel first(system.connect());
  REQUIRE(first.post(encode(Ask{"wait", {}, false}, 1)).ok());
  std::vector<Descriptor> crowd;
  for (std::size_t i = 0; i < 2 * ControlServer::kMostClients; ++i) {
    crowd.push_back(system.connect());
    system.serve();
  }
  REQUIRE(system.kept.size() == 1);
  system.kept.clear();
  CHECK(std::get<EndAnswer>(next(first)).outcome.ok());
}

TEST_CASE("a client is taken in although there are no descriptors left", "[supervisor][control]") {
  Served system;
  Channel client(system.connect());
  REQUIRE(client.post(encode(Ask{"ps", {}, false}, 1)).ok());
  system.serve();  // before descriptors are scarce
  (void)next(client), (void)next(client);
  Channel late(system.connect());
  REQUIRE(late.post(encode(Ask{"ps", {}, false}, 1)).ok());
  std::vector<Descriptor> all;
  while (Descriptor one{dup(0)}) all.push_back(std::move(one));
  system.serve();
  CHECK(system.asked == 2);
}
