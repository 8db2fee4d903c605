// SPDX-License-Identifier: GPL-3.0-or-later
#include "line_record.hpp"

#include <catch2/catch.hpp>

using namespace orca;
using namespace orca::hw;
using namespace std::chrono_literals;

namespace {

idl::DeviceStatistics read(const LineRecord& record) {
  idl::DeviceStatistics statistics;
  record.fill(statistics);
  return statistics;
}

}  // namespace

TEST_CASE("a line's counters go on over all connections, while the driver counts anew in each",
          "[line_record]") {
  LineRecord record;
  CHECK(read(record).connections() == 0);
  record.opened();
  record.answered();
  record.count({.frames = 10, .bad_checksums = 1, .skipped_bytes = 7, .resynchronisations = 2});
  record.count({.frames = 12, .bad_checksums = 1, .skipped_bytes = 7, .resynchronisations = 2});
  record.opened();  // and nobody answers
  record.opened();
  record.answered();
  record.count({.frames = 3, .bad_checksums = 2, .skipped_bytes = 1, .resynchronisations = 1});
  const idl::DeviceStatistics all = read(record);
  CHECK(all.connections() == 2);
  CHECK(all.frames() == 15);
  CHECK(all.bad_checksums() == 3);
  CHECK(all.skipped_bytes() == 8);
  CHECK(all.resynchronisations() == 3);
}

TEST_CASE("the latency of a line is that of its messages, on average and at most", "[line_record]") {
  LineRecord record;
  CHECK(read(record).mean_latency() == 0.0);
  record.heard(10ms);
  record.heard(40ms);
  record.heard(10ms);
  CHECK(read(record).mean_latency() == Approx(0.02));
  CHECK(read(record).max_latency() == Approx(0.04));
}
