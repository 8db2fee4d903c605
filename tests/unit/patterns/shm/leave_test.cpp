// SPDX-License-Identifier: GPL-3.0-or-later
// A connection to a server that does not answer, because it is in a long lap, is removed.
#include <catch2/catch.hpp>

#include "executives.hpp"
#include "orca/idl/motion.hpp"
#include "orca/idl/system.hpp"
#include "orca/patterns/endpoints/links.hpp"
#include "two_processes.hpp"

using namespace orca;
using namespace orca::test;
using Catch::Contains;
using idl::MotionCommand;

namespace {

struct Client : Peer {
  explicit Client(Executive& executive) : Peer(executive, "client") { strand().set_doorbell(page->parent); }

  [[nodiscard]] ShmPeer server(const std::string& port) { return {"server." + port, &page->child, {}}; }

  SharedPage page;
  QueryProxy<idl::Ask, MotionCommand> asks{*this, "asks"};
  SendProxy<MotionCommand> sends{*this, "sends"};
};

void check_removed(const Error& error) {
  CHECK(error.code == Code::unavailable);
  CHECK_THAT(error.message, Contains("was removed before the answer came"));
}

}  // namespace

TEST_CASE("to leave a server that does not answer takes no time, however many requests are open",
          "[patterns][shm][leave]") {
  run_on({}, [](Executive& executive) {
    const MemoryFile asked = RingSegment::create("asked", 4096).value();
    const MemoryFile sent = RingSegment::create("sent", 4096).value();
    Client client(executive);
    make_shm_end(static_cast<QueryClientEndpoint&>(client.endpoint("asks")), map(asked),
                 client.server("answers"));
    make_shm_end(static_cast<SendClientEndpoint&>(client.endpoint("sends")), map(sent), client.server("in"),
                 {});
    std::vector<QueryId> questions;
    std::vector<SendId> objects;
    for (int i = 0; i < 6; ++i) {
      questions.push_back(client.asks.query_request(client.asks.loan()).value());
      objects.push_back(client.sends.send_request(full_stop()).value());
    }
    const TimePoint began = executive.now();
    Links::leave(client.endpoint("asks"), "server.answers");
    Links::leave(client.endpoint("sends"), "server.in");
    CHECK(executive.now() - began < 1s);  // the wait for a server to confirm one withdrawal
    for (const QueryId id : questions) check_removed(client.asks.query_receive_wait(id, 0s).error());
    for (const SendId id : objects) check_removed(client.sends.send_receive_wait(id, 0s).error());
  });
}
