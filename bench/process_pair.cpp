// SPDX-License-Identifier: GPL-3.0-or-later
#include "process_pair.hpp"

#include <utility>

#include "bulk_pools.hpp"

namespace orca::bench {
namespace {

constexpr int kWarmUp = 2;

template <class Port>
Port& port(test::Peer& peer, const std::string& name) {
  return static_cast<Port&>(peer.endpoint(name));
}

MemoryFile make_file() { return RingSegment::create("bench").value(); }

// Makes that of the other process, and that of this one, which the other must know when it begins.
MemoryFile make_pools() {
  (void)test::own_pool();
  return test::make_pool();
}

}  // namespace

void ScanLoad::order(Object& scan, const Order& order) {
  scan.ranges().assign({static_cast<double>(order.count), static_cast<double>(order.size)});
}

std::optional<Order> ScanLoad::ordered(const Object& scan) {
  if (scan.ranges().size() != 2) return std::nullopt;
  return Order{static_cast<int>(scan.ranges()[0]), static_cast<std::size_t>(scan.ranges()[1])};
}

void ImageLoad::order(Object& image, const Order& order) {
  image.width(static_cast<std::uint32_t>(order.count));
  image.height(static_cast<std::uint32_t>(order.size));
}

std::optional<Order> ImageLoad::ordered(const Object& image) {
  if (image.width() == 0) return std::nullopt;
  return Order{static_cast<int>(image.width()), image.height()};
}

template <class Load>
struct ProcessPushPair<Load>::Both : test::Peer {
  using Object = typename Load::Object;

  Both(Executive& executive, const std::string& name) : Peer(executive, name) {}

  void make_ready(const Order& order) {
    ready.clear();
    for (int i = 0; i < order.count; ++i) {
      ready.push_back(make_object<Object>());
      Load::fill(*ready.back(), order.size);
    }
    // Filling large objects has driven the headers of the first ones out of the caches.
    for (auto& object : ready) object->origin() = "publisher";
    next = 0;
  }
  void push_next() { out.push(std::move(ready[next++])); }
  void order(const Order& order) {
    auto object = out.loan();
    Load::order(*object, order);
    out.push(std::move(object));
  }

  PushServer<Object> out{*this, "out"};
  PushProxy<Object> in{*this, "in"};
  std::vector<Loan<Object>> ready;
  std::size_t next = 0;
};

template <class Load>
ProcessPushPair<Load>::ProcessPushPair(Executive& executive)
    : there_(make_file()),
      back_(make_file()),
      pool_there_(make_pools()),
      other_([this](Executive& there) { echo(there); }),
      one_(std::make_unique<Both>(executive, "publisher")) {
  test::provide(test::own_pool());
  test::note_peer("subscriber", pool_there_);
  connect(*one_, false);
  one_->strand().wait_for(kForever, [this] { return one_->out.subscriber_count() == 1; });
}

template <class Load>
ProcessPushPair<Load>::~ProcessPushPair() = default;

template <class Load>
void ProcessPushPair<Load>::connect(Both& peer, bool is_child) {
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

template <class Load>
void ProcessPushPair<Load>::echo(Executive& executive) {
  test::provide(pool_there_);
  test::note_peer("publisher", test::own_pool());
  Both other(executive, "subscriber");
  connect(other, true);
  for (;;) {
    const auto got = other.in.get_update_wait();
    if (const std::optional<Order> order = Load::ordered(*got)) {
      other.make_ready(*order);
      other.order({1, 0});
    } else {
      other.push_next();
    }
  }
}

template <class Load>
Nanoseconds ProcessPushPair<Load>::time(int round_trips, std::size_t size) {
  const Order order{round_trips + kWarmUp, size};
  one_->make_ready(order);
  one_->order(order);
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

template class ProcessPushPair<ScanLoad>;
template class ProcessPushPair<ImageLoad>;

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
