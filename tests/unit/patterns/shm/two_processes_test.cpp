// SPDX-License-Identifier: GPL-3.0-or-later
// Edges between this process and others that it forks, kills and replaces.
#include "two_processes.hpp"

#include <catch2/catch.hpp>

#include <string>

#include "all_ports.hpp"
#include "executives.hpp"
#include "orca/base/log.hpp"
#include "orca/idl/motion.hpp"
#include "orca/idl/sensing.hpp"
#include "orca/idl/system.hpp"
#include "orca/patterns/synchronizer.hpp"

using namespace orca;
using namespace orca::test;
using Catch::Contains;
using idl::MotionCommand;
using Scan = idl::LaserRangeReadings;

namespace {

constexpr std::size_t kRanges = 361;  // 3 KB

struct Laser : Peer {
  explicit Laser(Executive& executive) : Peer(executive, "laser") {}
  void push(int number) {
    auto scan = out.loan();
    scan->ranges().assign(kRanges, number);
    out.push(std::move(scan));
  }
  PushServer<Scan> out{*this, "out"};
};

struct Mapper : Peer {
  explicit Mapper(Executive& executive) : Peer(executive, "mapper") {}
  PushProxy<Scan> in{*this, "in"};
};

struct Base : Peer {
  explicit Base(Executive& executive) : Peer(executive, "base") {}
  Status on_command(const ObjectPtr<MotionCommand>& command) {
    if (command->speed() < 0.0)
      for (;;) pause();  // hangs, to be killed
    sum += command->speed();
    return ok();
  }
  Result<Loan<MotionCommand>> on_ask(const ObjectPtr<idl::Ask>& ask) {
    if (ask->about() == "never")
      for (;;) pause();
    return head(0.0, static_cast<double>(ask->about().size()));
  }
  double sum = 0.0;
  SendServer<MotionCommand> in{*this, "in", &Base::on_command, {.depth = 1}};
  QueryServer<idl::Ask, MotionCommand> server{*this, "server", &Base::on_ask};
};

struct Pilot : Peer {
  explicit Pilot(Executive& executive) : Peer(executive, "pilot") {}
  [[nodiscard]] Loan<idl::Ask> about(const std::string& text) const {
    auto ask = question.loan();
    ask->about() = text;
    return ask;
  }
  SendProxy<MotionCommand> out{*this, "out"};
  QueryProxy<idl::Ask, MotionCommand> question{*this, "question"};
  PushProxy<MotionCommand> commands{*this, "commands"};
};

constexpr QueuePolicy kAll{.depth = 4, .overflow = QueuePolicy::Overflow::block, .block_limit = 10s};

// Pushes scans 1 to `count` once there is a subscriber.
void run_laser(Executive& executive, SharedPage& page, const MemoryFile& file, const QueuePolicy& policy,
               int count) {
  Laser laser(executive);
  laser.strand().set_doorbell(page->child);
  make_shm_end(port<PushServerEndpoint>(laser, "out"), map(file), {"mapper.in", &page->parent}, policy);
  laser.strand().wait_for(kForever, [&] { return laser.out.subscriber_count() == 1; });
  for (int number = 1; number <= count; ++number) laser.push(number);
  laser.strand().wait_for(kForever, [&] { return laser.out.subscriber_count() == 0; });
}

ShmEnd& connect_laser(Mapper& mapper, SharedPage& page, const MemoryFile& file, const QueuePolicy& policy) {
  mapper.strand().set_doorbell(page->parent);
  return make_shm_end(port<PushClientEndpoint>(mapper, "in"), map(file), {"laser.out", &page->child}, policy,
                      Duration{0});
}

void run_base(Executive& executive, SharedPage& page, const MemoryFile& sends, const MemoryFile& queries) {
  Base base(executive);
  base.strand().set_doorbell(page->child);
  make_shm_end(port<SendServerEndpoint>(base, "in"), map(sends), {"pilot.out", &page->parent}, {.depth = 1});
  make_shm_end(port<QueryServerEndpoint>(base, "server"), map(queries), {"pilot.question", &page->parent});
  serve_for_ever(base);
}

MemoryFile make_file() { return RingSegment::create("test").value(); }

// A pilot here whose base is in another process, which can be replaced.
struct Bridge {
  explicit Bridge(Executive& executive) : pilot(executive) {
    pilot.strand().set_doorbell(page->parent);
    sends =
        &make_shm_end(port<SendClientEndpoint>(pilot, "out"), map(send_file), {"base.in", &page->child}, {});
    queries = &make_shm_end(port<QueryClientEndpoint>(pilot, "question"), map(query_file),
                            {"base.server", &page->child});
  }
  void replace_base() {
    base->kill_now();
    sends->cut(fail(Code::unavailable, "its process was killed"));
    queries->cut(fail(Code::unavailable, "its process was killed"));
  }
  void renew() {
    send_file = make_file();
    query_file = make_file();
    base.emplace([this](Executive& executive) { run_base(executive, page, send_file, query_file); });
    sends->renew(map(send_file));
    queries->renew(map(query_file));
  }

  SharedPage page;
  MemoryFile send_file = make_file();
  MemoryFile query_file = make_file();
  std::optional<OtherProcess> base{
      std::in_place, [this](Executive& executive) { run_base(executive, page, send_file, query_file); }};
  Pilot pilot;
  ShmEnd* sends = nullptr;
  ShmEnd* queries = nullptr;
};

}  // namespace

TEST_CASE("scans pass from process to process, whole, in order, and none is lost",
          "[patterns][shm][processes]") {
  constexpr int kScans = 3000;
  SharedPage page;
  const MemoryFile file = make_file();
  OtherProcess child([&](Executive& executive) { run_laser(executive, page, file, kAll, kScans); });
  run_on({}, [&](Executive& executive) {
    Mapper mapper(executive);
    const ShmEnd& end = connect_laser(mapper, page, file, kAll);
    mapper.in.subscribe();
    for (int number = 1; number <= kScans; ++number) {
      const ObjectPtr<Scan> scan = mapper.in.get_update_wait_max(5s);
      REQUIRE(scan);
      REQUIRE(scan->ranges() == std::vector<double>(kRanges, number));
      REQUIRE(scan->origin() == "laser");
    }
    mapper.in.unsubscribe();
    CHECK(end.counters().peers_cut_off == 0);
  });
  CHECK(child.join() == 0);
}

TEST_CASE("a component that never waits, but looks, sees what comes from another process",
          "[patterns][shm][processes]") {
  SharedPage page;
  const MemoryFile file = make_file();
  OtherProcess child([&](Executive& executive) { run_laser(executive, page, file, {}, 5); });
  run_on({}, [&](Executive& executive) {
    Mapper mapper(executive);
    connect_laser(mapper, page, file, {});
    mapper.in.subscribe();
    const TimePoint limit = executive.now() + 5s;
    while (executive.now() < limit && !(mapper.in.latest() && mapper.in.latest()->ranges()[0] == 5.0)) {
    }
    CHECK(executive.now() < limit);
    CHECK(mapper.in.new_data_arrived());
    mapper.in.unsubscribe();
  });
  CHECK(child.join() == 0);
}

TEST_CASE("questions and sent objects pass from process to process", "[patterns][shm][processes]") {
  run_on({}, [](Executive& executive) {
    Bridge bridge(executive);
    for (int i = 0; i < 500; ++i) {
      while (!bridge.pilot.out.send(head(0.0, 1.0)).ok()) executive.sleep_until(executive.now() + 1ms);
      const auto answer = bridge.pilot.question.query(bridge.pilot.about("12345"), 5s);
      REQUIRE(answer);
      REQUIRE((*answer)->speed() == 5.0);
    }
  });
}

TEST_CASE("whoever waits for a process that is killed gets an error at once, and its successor serves him",
          "[patterns][shm][processes]") {
  run_on({}, [](Executive& executive) {
    Bridge bridge(executive);
    for (int round = 0; round < 5; ++round) {
      REQUIRE(bridge.pilot.question.query(bridge.pilot.about("12"), 5s));
      const Result<QueryId> open = bridge.pilot.question.query_request(bridge.pilot.about("never"));
      REQUIRE(open);
      const Result<SendId> sent = bridge.pilot.out.send_request(head(0.0, 1.0));
      REQUIRE(sent);
      bridge.replace_base();
      const TimePoint start = executive.now();
      const auto answer = bridge.pilot.question.query_receive_wait(*open, 10s);
      REQUIRE_FALSE(answer);
      CHECK(answer.error().code == Code::unavailable);
      CHECK_THAT(answer.error().text(), Contains("base.server cannot be reached") && Contains("was killed"));
      (void)bridge.pilot.out.send_receive_wait(*sent, 10s);
      CHECK_FALSE(bridge.pilot.out.send(head(0.0, 1.0)).ok());
      CHECK(executive.now() - start < 1s);
      bridge.renew();
      const auto again = [&] {
        return bridge.pilot.question.query(bridge.pilot.about("123"), 5s).has_value();
      };
      CHECK(eventually(executive, again));
      CHECK(bridge.pilot.out.send(head(0.0, 1.0)).ok());
    }
    CHECK(bridge.queries->counters().peers_cut_off == 0);
  });
}

TEST_CASE("a subscription stands again when the server's process was replaced, without the client's doing",
          "[patterns][shm][processes]") {
  SharedPage page;
  run_on({}, [&](Executive& executive) {
    Mapper mapper(executive);
    ShmEnd* end = nullptr;
    for (int round = 0; round < 5; ++round) {
      const MemoryFile file = make_file();
      OtherProcess child([&](Executive& there) { run_laser(there, page, file, {.depth = 100}, 10); });
      if (end == nullptr) {
        end = &connect_laser(mapper, page, file, {.depth = 100});
        mapper.in.subscribe();
      } else {
        end->renew(map(file));
      }
      for (int number = 1; number <= 10; ++number) {
        const ObjectPtr<Scan> scan = mapper.in.get_update_wait_max(5s);
        REQUIRE(scan);
        CHECK(scan->ranges()[0] == number);
      }
      child.kill_now();
      if (round % 2 == 0) end->cut(fail(Code::unavailable, "its process was killed"));
    }
    mapper.in.unsubscribe();
  });
}

TEST_CASE("a client that is killed is no subscriber any more, and its successor is one",
          "[patterns][shm][processes]") {
  SharedPage page;
  run_on({}, [&](Executive& executive) {
    Laser laser(executive);
    laser.strand().set_doorbell(page->parent);
    ShmEnd* end = nullptr;
    const QueuePolicy policy{.overflow = QueuePolicy::Overflow::block, .block_limit = 1h};
    for (int round = 0; round < 3; ++round) {
      const MemoryFile file = make_file();
      OtherProcess child([&](Executive& there) {
        Mapper mapper(there);
        mapper.strand().set_doorbell(page->child);
        make_shm_end(port<PushClientEndpoint>(mapper, "in"), map(file), {"laser.out", &page->parent}, policy,
                     Duration{0});
        mapper.in.subscribe();
        there.sleep_until(there.now() + 1h);  // takes nothing
      });
      if (end == nullptr) {
        end = &make_shm_end(port<PushServerEndpoint>(laser, "out"), map(file), {"mapper.in", &page->child},
                            policy);
      } else {
        end->renew(map(file));
      }
      REQUIRE(
          laser.strand().wait_for(executive.now() + 5s, [&] { return laser.out.subscriber_count() == 1; }));
      child.kill_now();
      end->cut(fail(Code::unavailable, "its process was killed"));
      const TimePoint start = executive.now();
      for (int number = 0; number < 3; ++number) laser.push(number);  // does not wait for the dead
      CHECK(executive.now() - start < 5s);
      CHECK(laser.out.subscriber_count() == 0);
    }
  });
}

TEST_CASE("a client counts how often its server was replaced, and a wait ends when it is",
          "[patterns][shm][processes]") {
  run_on({}, [](Executive& executive) {
    Bridge bridge(executive);
    Pilot& pilot = bridge.pilot;
    Synchronizer commands;
    commands.add(pilot.commands);
    CHECK(pilot.out.server_restarts() == 0);
    CHECK(pilot.question.server_restarts() == 0);
    for (std::uint64_t count = 1; count <= 3; ++count) {
      bridge.replace_base();
      CHECK(pilot.out.server_restarts() == count - 1);
      bridge.renew();
      const TimePoint start = executive.now();
      CHECK(commands.wait(10s, [&] { return pilot.out.server_restarts() == count; }) == nullptr);
      CHECK(executive.now() - start < 5s);
      CHECK(pilot.question.server_restarts() == count);
    }
  });
}

TEST_CASE("a process that ends in order is seen to be gone without anybody's word",
          "[patterns][shm][processes]") {
  SharedPage page;
  const MemoryFile file = make_file();
  OtherProcess child([&](Executive& there) {
    Mapper mapper(there);
    mapper.strand().set_doorbell(page->child);
    make_shm_end(port<PushClientEndpoint>(mapper, "in"), map(file), {"laser.out", &page->parent}, {},
                 Duration{0});
    mapper.in.subscribe();
    there.sleep_until(there.now() + 50ms);
  });
  run_on({}, [&](Executive& executive) {
    Laser laser(executive);
    laser.strand().set_doorbell(page->parent);
    make_shm_end(port<PushServerEndpoint>(laser, "out"), map(file), {"mapper.in", &page->child}, {});
    const auto subscribers = [&] { return laser.out.subscriber_count(); };
    REQUIRE(laser.strand().wait_for(executive.now() + 5s, [&] { return subscribers() == 1; }));
    CHECK(laser.strand().wait_for(executive.now() + 5s, [&] { return subscribers() == 0; }));
  });
  CHECK(child.join() == 0);
}

TEST_CASE("what finds no room on the way is dropped and counted, or refused with the reason",
          "[patterns][shm][processes]") {
  SharedPage page;
  run_on({}, [&](Executive& executive) {
    const MemoryFile file = RingSegment::create("test", 4096).value();  // its other end never reads
    Pilot pilot(executive);
    pilot.strand().set_doorbell(page->parent);
    make_shm_end(port<SendClientEndpoint>(pilot, "out"), map(file), {"base.in", &page->child}, {});
    Status refused;
    for (int i = 0; i < 100 && refused.ok(); ++i)
      if (const auto id = pilot.out.send_request(head(0.0, 1.0)))
        if (const auto outcome = pilot.out.send_receive(*id)) refused = *outcome;
    REQUIRE_FALSE(refused.ok());
    CHECK(refused.error().code == Code::unavailable);
    CHECK_THAT(refused.error().text(), Contains("its queue between the processes is full"));
  });
}

TEST_CASE("an object that is larger than a link can carry is dropped, counted, and named in the log once",
          "[patterns][shm][processes]") {
  std::vector<std::string> lines;
  const log::Listener listener([&](const log::Line& line) { lines.emplace_back(line.text); });
  SharedPage page;
  run_on({}, [&](Executive& executive) {
    const MemoryFile file = RingSegment::create("test", 4096).value();
    Laser laser(executive);
    Mapper mapper(executive);
    laser.strand().set_doorbell(page->parent);
    mapper.strand().set_doorbell(page->child);
    auto& end =
        make_shm_end(port<PushServerEndpoint>(laser, "out"), map(file), {"mapper.in", &page->child}, {});
    make_shm_end(port<PushClientEndpoint>(mapper, "in"), map(file), {"laser.out", &page->parent}, {},
                 Duration{0});
    mapper.in.subscribe();
    REQUIRE(laser.strand().take_in());
    for (int number = 0; number < 3; ++number) {
      auto large = laser.out.loan();
      large->ranges().assign(1000, 1.0);
      laser.out.push(std::move(large));
    }
    CHECK(end.counters().objects_lost == 3);
    auto small = laser.out.loan();
    small->ranges().assign(3, 1.0);
    laser.out.push(std::move(small));
    CHECK(mapper.in.get_update_wait_max(5s));
    CHECK(mapper.in.counters().dropped_by_link == 3);
  });
  REQUIRE(lines.size() == 1);
  CHECK_THAT(lines[0], Contains("an object takes more than the 4088 bytes"));
}
