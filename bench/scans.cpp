// SPDX-License-Identifier: GPL-3.0-or-later
#include "scans.hpp"

#include <stdexcept>

namespace orca::bench {

std::vector<Loan<Scan>> make_scans(int count, std::size_t ranges) {
  std::vector<Loan<Scan>> scans;
  for (int i = 0; i < count; ++i) {
    scans.push_back(make_object<Scan>());
    scans.back()->ranges().resize(ranges);
  }
  // Filling large scans has driven the headers of the first ones out of the caches.
  for (Loan<Scan>& scan : scans) {
    scan->origin() = "publisher";
    scan->stamp().ns(1);
  }
  return scans;
}

Nanoseconds copy_image(int times) {
  static const std::vector<double> from(kImage, 1.0);
  static std::vector<double> to(kImage);
  return time_per_operation(times, [times] {
    for (int i = 0; i < times; ++i) {
      to = from;
      benchmark::DoNotOptimize(to.data());
      benchmark::ClobberMemory();
    }
  });
}

void subscribe(Publisher& publisher, Subscriber& subscriber, const QueuePolicy& policy) {
  const Status connected = LocalLinks().connect(publisher.endpoint("out"), subscriber.endpoint("in"), policy);
  if (!connected.ok()) throw std::runtime_error(connected.error().text());
  subscriber.in.subscribe();
}

}  // namespace orca::bench
