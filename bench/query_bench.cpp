// SPDX-License-Identifier: GPL-3.0-or-later
// Time of one question and its answer.
#include "bare_threads.hpp"
#include "benchmarks.hpp"
#include "comparison.hpp"
#include "on_executive.hpp"
#include "orca/idl/motion.hpp"
#include "orca/idl/system.hpp"
#include "scans.hpp"

namespace orca::bench {
namespace {

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

class QueryPair {
 public:
  explicit QueryPair(Executive& executive) : asker_(executive), answerer_(executive) {
    const Status connected = LocalLinks().connect(asker_.endpoint("question"), answerer_.endpoint("server"));
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
  Asker asker_;
  Answerer answerer_;
  std::optional<test::Service> service_;
};

void beside_condition_variables(benchmark::State& state, Row& row, const ExecutiveOptions& options,
                                int questions) {
  run_on(options, [&](Executive& executive) {
    QueryPair pair(executive);
    ConditionPair bare;
    alternate(
        state, row, questions, [&](int n) { return pair.time(n); }, [&](int n) { return bare.time(n); });
  });
}

}  // namespace

void register_query() {
  add_row({"query between threads", "the same with condition variables", ratio_at_most(1.25)}, 2000,
          [](auto& state, Row& row) { beside_condition_variables(state, row, kThreads, 5); });
  add_row({"query, same executor", "condition variables, two threads"}, 1000,
          [](auto& state, Row& row) { beside_condition_variables(state, row, kFibers, 20); });
}

}  // namespace orca::bench
