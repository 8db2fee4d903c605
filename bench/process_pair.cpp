// SPDX-License-Identifier: GPL-3.0-or-later
#include "process_pair.hpp"

#include <utility>

namespace orca::bench {
namespace {

constexpr int kWarmUp = 2;

template <class Port>
Port& port(test::Peer& peer, const std::string& name) {
  return static_cast<Port&>(peer.endpoint(name));
}

MemoryFile make_file() { return RingSegment::create("bench").value(); }

}  // namespace

// A scan of one range orders so many scans to be made ready.
struct ProcessPushPair::Both : test::Peer {
  Both(Executive& executive, const std::string& name) : Peer(executive, name) {}

  void make_ready(int count, std::size_t ranges) {
    ready = make_scans(count, ranges);
    next = 0;
  }
  void push_next() { out.push(std::move(ready[next++])); }
  void order(double count) {
    auto scan = out.loan();
    scan->ranges().assign(1, count);
    out.push(std::move(scan));
  }

  PushServer<Scan> out{*this, "out"};
  PushProxy<Scan> in{*this, "in"};
  std::vector<Loan<Scan>> ready;
  std::size_t next = 0;
};

ProcessPushPair::ProcessPushPair(Executive& executive, std::size_t ranges)
    : ranges_(ranges),
      there_(make_file()),
      back_(make_file()),
      other_([this](Executive& there) { echo(there); }),
      one_(std::make_unique<Both>(executive, "publisher")) {
  connect(*one_, false);
  one_->strand().wait_for(kForever, [this] { return one_->out.subscriber_count() == 1; });
}

ProcessPushPair::~ProcessPushPair() = default;

void ProcessPushPair::connect(Both& peer, bool is_child) {
  DoorbellWord& own = is_child ? page_->child : page_->parent;
  DoorbellWord& others = is_child ? page_->parent : page_->child;
  const QueuePolicy policy{.depth = 2};
  peer.strand().set_doorbell(own);
  make_shm_end(port<PushServerEndpoint>(peer, "out"), test::map(is_child ? back_ : there_),
               {"other.in", &others}, policy);
  make_shm_end(port<PushClientEndpoint>(peer, "in"), test::map(is_child ? there_ : back_),
               {"other.out", &others}, policy, Duration{0});
  peer.in.subscribe();
}

void ProcessPushPair::echo(Executive& executive) {
  Both other(executive, "subscriber");
  connect(other, true);
  for (;;) {
    const ObjectPtr<Scan> got = other.in.get_update_wait();
    if (got->ranges().size() == 1) {
      other.make_ready(static_cast<int>(got->ranges()[0]), ranges_);
      other.order(0.0);
    } else {
      other.push_next();
    }
  }
}

Nanoseconds ProcessPushPair::time(int round_trips) {
  one_->make_ready(round_trips + kWarmUp, ranges_);
  one_->order(round_trips + kWarmUp);
  (void)one_->in.get_update_wait();
  const auto run = [this](int count) {
    for (int i = 0; i < count; ++i) {
      one_->push_next();
      benchmark::DoNotOptimize(one_->in.get_update_wait());
    }
  };
  run(kWarmUp);
  return time_per_operation(2 * round_trips, [&] { run(round_trips); });
}

struct ProcessQueryPair::Asker : test::Peer {
  explicit Asker(Executive& executive) : Peer(executive, "asker") {}
  QueryProxy<idl::Ask, idl::MotionCommand> question{*this, "question"};
};

ProcessQueryPair::ProcessQueryPair(Executive& executive)
    : file_(make_file()),
      other_([this](Executive& there) { answer(there); }),
      asker_(std::make_unique<Asker>(executive)) {
  asker_->strand().set_doorbell(page_->parent);
  make_shm_end(port<QueryClientEndpoint>(*asker_, "question"), test::map(file_),
               {"answerer.server", &page_->child});
}

ProcessQueryPair::~ProcessQueryPair() = default;

void ProcessQueryPair::answer(Executive& executive) {
  struct Answerer : test::Peer {
    explicit Answerer(Executive& there) : Peer(there, "answerer") {}
    Result<Loan<idl::MotionCommand>> on_ask(const ObjectPtr<idl::Ask>&) {
      return make_object<idl::MotionCommand>();
    }
    QueryServer<idl::Ask, idl::MotionCommand> server{*this, "server", &Answerer::on_ask};
  };
  Answerer answerer(executive);
  answerer.strand().set_doorbell(page_->child);
  make_shm_end(port<QueryServerEndpoint>(answerer, "server"), test::map(file_),
               {"asker.question", &page_->parent});
  test::serve_for_ever(answerer);
}

Nanoseconds ProcessQueryPair::time(int questions) {
  return time_per_operation(questions, [&] {
    for (int i = 0; i < questions; ++i)
      benchmark::DoNotOptimize(asker_->question.query(asker_->question.loan(), 10s).value());
  });
}

}  // namespace orca::bench
