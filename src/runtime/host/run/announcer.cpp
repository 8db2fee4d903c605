// SPDX-License-Identifier: LGPL-3.0-or-later
#include "announcer.hpp"

#include <cinttypes>
#include <cstdio>

namespace orca::host {

void Announcer::announce(const Announcement& announcement) {
  const std::lock_guard lock(mutex_);
  const double t = to_seconds(announcement.time - start_);
  if (announcement.kind == "arrived") {
    std::printf("arrived %s %.3f %.3f %.2f\n", announcement.name.c_str(), announcement.x, announcement.y, t);
  } else {
    std::printf("%s %s %.2f\n", announcement.kind.c_str(), announcement.name.c_str(), t);
  }
  std::fflush(stdout);
  said_.push_back(announcement);
}

void Announcer::print_trace_hash(std::uint64_t hash) {
  std::printf("trace-hash %016" PRIx64 "\n", hash);
  std::fflush(stdout);
}

void Announcer::draw(Scene& scene) const {
  const std::lock_guard lock(mutex_);
  for (const Announcement& said : said_)
    (said.kind == "contact" ? scene.contacts : scene.arrivals)
        .push_back({said.name, {said.x, said.y}, said.time});
}

}  // namespace orca::host
