// SPDX-License-Identifier: GPL-3.0-or-later
#include "push_pair.hpp"

#include <stdexcept>

namespace orca::bench {
namespace {

constexpr int kWarmUp = 4;

void connect(Links& links, test::Peer& from, test::Peer& to) {
  const Status connected = links.connect(from.endpoint("out"), to.endpoint("in"));
  if (!connected.ok()) throw std::runtime_error(connected.error().text());
}

}  // namespace

PushPair::PushPair(Executive& executive, std::size_t ranges, Links& links)
    : ranges_(ranges), one_(executive, "publisher"), other_(executive, "subscriber") {
  connect(links, one_, other_);
  connect(links, other_, one_);
  one_.in.subscribe();
  other_.in.subscribe();
  echo_.emplace(other_, [this] {
    for (;;) {
      const ObjectPtr<Scan> got = other_.in.get_update_wait();
      other_.push_next();
    }
  });
  one_.strand().wait_for(kForever, [this] { return one_.out.subscriber_count() == 1; });
}

Nanoseconds PushPair::time(int round_trips) {
  for (Both* peer : {&one_, &other_}) {
    peer->ready = make_scans(round_trips + kWarmUp, ranges_);
    peer->next = 0;
  }
  const auto run = [this](int count) {
    for (int i = 0; i < count; ++i) {
      one_.push_next();
      benchmark::DoNotOptimize(one_.in.get_update_wait());
    }
  };
  run(kWarmUp);
  return time_per_operation(2 * round_trips, [&] { run(round_trips); });
}

}  // namespace orca::bench
