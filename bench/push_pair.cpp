// SPDX-License-Identifier: GPL-3.0-or-later
#include "push_pair.hpp"

#include <stdexcept>

namespace orca::bench {
namespace {

constexpr int kWarmUp = 4;

void connect(test::Peer& from, test::Peer& to) {
  const Status connected = LocalLinks().connect(from.endpoint("out"), to.endpoint("in"));
  if (!connected.ok()) throw std::runtime_error(connected.error().text());
}

}  // namespace

PushPair::PushPair(Executive& executive, std::size_t ranges)
    : ranges_(ranges), one_(executive, "publisher"), other_(executive, "subscriber"), echo_(other_, [this] {
        for (;;) {
          const ObjectPtr<Scan> got = other_.in.get_update_wait();
          other_.push_next();
        }
      }) {
  connect(one_, other_);
  connect(other_, one_);
  one_.in.subscribe();
  other_.in.subscribe();
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
