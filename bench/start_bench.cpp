// SPDX-License-Identifier: GPL-3.0-or-later
// From nothing to the first object on each of 100 edges between two components, and the same for bare Fast DDS.
#include <chrono>
#include <deque>
#include <memory>
#include <stdexcept>
#include <string>
#include <utility>

#include "bare_dds.hpp"
#include "bench_keys.hpp"
#include "benchmarks.hpp"
#include "comparison.hpp"
#include "dds_links.hpp"
#include "on_executive.hpp"
#include "orca/patterns/shm/shm_edges.hpp"
#include "scans.hpp"

namespace orca::bench {
namespace {

constexpr int kEdges = 100;
constexpr Nanoseconds kMillisecond = 1e6;

std::string numbered(const std::string& name, int number) { return name + std::to_string(number); }

struct ManyPublisher : test::Peer {
  explicit ManyPublisher(Executive& executive) : Peer(executive, "publisher") {
    for (int i = 0; i < kEdges; ++i) out.emplace_back(*this, numbered("out", i));
  }
  void push_all() {
    for (PushServer<Scan>& port : out) {
      strand().wait_for(kForever, [&] { return port.subscriber_count() == 1; });
      port.push(std::move(make_scans(1, kSmall).front()));
    }
  }
  std::deque<PushServer<Scan>> out;
};

struct ManySubscriber : test::Peer {
  explicit ManySubscriber(Executive& executive) : Peer(executive, "subscriber") {
    for (int i = 0; i < kEdges; ++i) in.emplace_back(*this, numbered("in", i));
  }
  void subscribe_all() {
    for (PushProxy<Scan>& port : in) port.subscribe();
  }
  void take_all() {
    for (PushProxy<Scan>& port : in) benchmark::DoNotOptimize(port.get_update_wait());
  }
  std::deque<PushProxy<Scan>> in;
};

using Clock = std::chrono::steady_clock;

// Joins two components by an edge for each pair of their ports. Returns how long it has taken since `began` until each has
// carried an object; taking everything down again does not count.
template <class Connect>
Nanoseconds start(Clock::time_point began, Executive& executive, const Connect& connect) {
  ManyPublisher publisher(executive);
  ManySubscriber subscriber(executive);
  for (int i = 0; i < kEdges; ++i)
    connect(publisher, publisher.endpoint(numbered("out", i)), subscriber,
            subscriber.endpoint(numbered("in", i)));
  subscriber.subscribe_all();
  publisher.push_all();
  subscriber.take_all();
  return std::chrono::duration<double, std::nano>(Clock::now() - began).count();
}

Nanoseconds start_shm(Executive& executive) {
  const Clock::time_point began = Clock::now();
  DoorbellWord bells[2] = {0, 0};
  bool has_bells = false;
  return start(began, executive, [&](test::Peer& from, Endpoint& out, test::Peer& to, Endpoint& in) {
    if (!std::exchange(has_bells, true)) {
      from.strand().set_doorbell(bells[0]);
      to.strand().set_doorbell(bells[1]);
    }
    const MemoryFile file = RingSegment::create("bench").value();
    const auto map = [&] { return RingSegment::map(file.descriptor()).value(); };
    make_shm_end(static_cast<PushServerEndpoint&>(out), map(), {in.path(), &bells[1]}, {});
    make_shm_end(static_cast<PushClientEndpoint&>(in), map(), {out.path(), &bells[0]}, {}, Duration{0});
  });
}

Nanoseconds start_dds(Executive& executive, const std::string& keys = {}) {
  const Clock::time_point began = Clock::now();
  const std::string run = test::fresh_run();
  const std::unique_ptr<DdsBackend> servers = test::make_dds("servers", run, keys);
  const std::unique_ptr<DdsBackend> clients = test::make_dds("clients", run, keys);
  std::uint64_t edges = 0;
  const auto must = [](const Status& done) {
    if (!done.ok()) throw std::runtime_error(done.error().text());
  };
  return start(began, executive, [&](test::Peer& /*from*/, Endpoint& out, test::Peer& /*to*/, Endpoint& in) {
    must(servers->connect(out, {in.path(), "clients", {}, ++edges}, {}, Duration{0}));
    must(clients->connect(in, {out.path(), "servers", out.contract().type.name, edges}, {}, Duration{0}));
  });
}

void shm_starts(benchmark::State& state, Row& row) {
  run_on(kThreads,
         [&](Executive& executive) { measure(state, row, 1, [&](int) { return start_shm(executive); }); });
}

void dds_starts(benchmark::State& state, Row& row) {
  run_on(kThreads, [&](Executive& executive) {
    alternate(
        state, row, 1, [&](int) { return start_dds(executive); },
        [](int) { return start_bare_dds(kEdges, kSmall * sizeof(double), test::dds_test_domain()); });
  });
}

void secured_starts(benchmark::State& state, Row& row) {
  const BenchKeys keys;
  run_on(kThreads, [&](Executive& executive) {
    alternate(
        state, row, 1, [&](int) { return start_dds(executive, keys.folder()); },
        [&](int) { return start_dds(executive); });
  });
}

}  // namespace

void register_start() {
  add_row({"start of 100 edges between processes", "", median_at_most(100 * kMillisecond)}, 20, shm_starts);
  add_row({"start of 100 topics over DDS", "bare Fast DDS, UDP loopback", ratio_at_most(1.2)}, 40,
          dds_starts);
  add_row({"start of 100 secured topics", "start of 100 topics over DDS", {}}, 20, secured_starts);
}

}  // namespace orca::bench
