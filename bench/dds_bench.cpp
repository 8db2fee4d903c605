// SPDX-License-Identifier: GPL-3.0-or-later
// The link through DDS: time of one push and of one question, on one processor, beside a bare Fast DDS program. Both have
// two participants in one process, which talk through UDP on the loopback interface as two processes do.
#include <optional>
#include <stdexcept>

#include "bare_dds.hpp"
#include "bench_keys.hpp"
#include "benchmarks.hpp"
#include "comparison.hpp"
#include "dds_links.hpp"
#include "on_executive.hpp"
#include "orca/idl/motion.hpp"
#include "orca/idl/system.hpp"
#include "push_pair.hpp"

namespace orca::bench {
namespace {

constexpr std::size_t kMessage = 128;  // [bytes] about a question with its header

using Answer = idl::MotionCommand;

struct Asker : test::Peer {
  explicit Asker(Executive& executive) : Peer(executive, "asker") {}
  QueryProxy<idl::Ask, Answer> question{*this, "question"};
};

struct Answerer : test::Peer {
  explicit Answerer(Executive& executive) : Peer(executive, "answerer") {}
  Result<Loan<Answer>> on_ask(const ObjectPtr<idl::Ask>&) { return make_object<Answer>(); }
  QueryServer<idl::Ask, Answer> server{*this, "server", &Answerer::on_ask};
};

class DdsQueryPair {
 public:
  explicit DdsQueryPair(Executive& executive)
      : links_(executive, test::DdsLinks::Help::none), asker_(executive), answerer_(executive) {
    const Status connected = links_.connect(asker_.endpoint("question"), answerer_.endpoint("server"));
    if (!connected.ok()) throw std::runtime_error(connected.error().text());
    service_.emplace(answerer_);
  }

  Nanoseconds time(int questions) {
    return time_per_operation(questions, [&] {
      for (int i = 0; i < questions; ++i)
        benchmark::DoNotOptimize(asker_.question.query(asker_.question.loan(), 10s).value());
    });
  }

 private:
  test::DdsLinks links_;
  Asker asker_;
  Answerer answerer_;
  std::optional<test::Service> service_;
};

void push_beside_bare(benchmark::State& state, Row& row, std::size_t ranges, int round_trips) {
  run_on(kThreads, [&](Executive& executive) {
    test::DdsLinks links(executive, test::DdsLinks::Help::none);
    PushPair pair(executive, ranges, links);
    BareDdsPair bare(ranges * sizeof(double), test::dds_test_domain());
    alternate(
        state, row, round_trips, [&](int n) { return pair.time(n); }, [&](int n) { return bare.time(n); });
  });
}

void secured_push(benchmark::State& state, Row& row, std::size_t ranges) {
  const BenchKeys keys;
  run_on(kThreads, [&](Executive& executive) {
    test::DdsLinks secured(executive, test::DdsLinks::Help::none, Duration{0}, keys.folder());
    test::DdsLinks plain(executive, test::DdsLinks::Help::none);
    PushPair subject(executive, ranges, secured);
    PushPair reference(executive, ranges, plain);
    alternate(
        state, row, 5, [&](int n) { return subject.time(n); }, [&](int n) { return reference.time(n); });
  });
}

void query_beside_bare(benchmark::State& state, Row& row) {
  run_on(kThreads, [&](Executive& executive) {
    DdsQueryPair pair(executive);
    BareDdsPair bare(kMessage, test::dds_test_domain());
    alternate(
        state, row, 5, [&](int n) { return pair.time(n); }, [&](int n) { return 2 * bare.time(n); });
  });
}

}  // namespace

void register_dds() {
  add_row({"push 3 KB over DDS", "bare Fast DDS, UDP loopback", ratio_at_most(1.15)}, 1000,
          [](auto& state, Row& row) { push_beside_bare(state, row, kLaser, 5); });
  add_row({"push 1 MB over DDS", "bare Fast DDS, UDP loopback", ratio_at_most(1.15)}, 50,
          [](auto& state, Row& row) { push_beside_bare(state, row, kImage, 1); });
  add_row({"push 3 KB over secured DDS", "push 3 KB over DDS", ratio_at_most(1.3)}, 1000,
          [](auto& state, Row& row) { secured_push(state, row, kLaser); });
  add_row({"query over DDS", "two messages, bare Fast DDS", ratio_at_most(1.15)}, 1000, query_beside_bare);
}

}  // namespace orca::bench
