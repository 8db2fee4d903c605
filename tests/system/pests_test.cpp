// SPDX-License-Identifier: GPL-3.0-or-later
// What a client that behaves badly costs a control loop in another process.
#include <algorithm>
#include <catch2/catch.hpp>
#include <cstdio>
#include <string>
#include <thread>
#include <vector>

#include "deployer.hpp"
#include "number_file.hpp"
#include "temp_folder.hpp"

using namespace orca::test;

namespace {

// Runs the loop beside a client and returns the times between its laps, in ascending order [s].
std::vector<double> laps_beside(const std::string& manner, const std::string& link, Seconds duration) {
  const TempFolder folder;
  const Run run = run_deployer(
      Words{system_graph("pest.xml")} + with_test_plugins() +
          Words{"--set", "manner=" + manner, "--set", "link=" + link, "--set", "path=" + folder.file("laps"),
                "--until", std::to_string(duration.count()) + " s"},
      duration + Seconds(20));
  INFO(run.err);
  // A run that ends while one of its processes hangs has failed.
  CHECK((run.exit_code() == 0 || manner == "stop"));
  std::vector<double> laps;
  for (const std::int64_t ns : read_numbers(folder.file("laps")))
    laps.push_back(1e-9 * static_cast<double>(ns));
  std::ranges::sort(laps);
  return laps;
}

double p99(const std::vector<double>& laps) { return laps[laps.size() * 99 / 100]; }

// Runs the loop beside a client, checks that it never stood still, and returns the p99 of the times between its laps [s].
double p99_beside(const std::string& manner, const std::string& link, Seconds duration) {
  CAPTURE(manner, link);
  const auto wanted = static_cast<std::size_t>(duration / Seconds(0.01));
  const std::vector<double> laps = laps_beside(manner, link, duration);
  REQUIRE(laps.size() > wanted * 8 / 10);
  std::printf("%s %-10s p99 %7.3f ms, longest %7.3f ms, %zu laps\n", link.c_str(), manner.c_str(),
              1e3 * p99(laps), 1e3 * laps.back(), laps.size());
  CHECK(laps.back() < 0.5);
  return p99(laps);
}

const std::vector<std::string> kBadManners{"exit", "kill", "stop", "deaf", "push_flood", "send_flood"};

// The median of three runs beside a bad client over that of three beside a good one, in turn.
double slowdown(const std::string& manner, const std::string& link) {
  std::vector<double> good, bad;
  for (int i = 0; i < 3; ++i) {
    good.push_back(p99_beside("good", link, Seconds(8)));
    bad.push_back(p99_beside(manner, link, Seconds(8)));
  }
  std::ranges::sort(good);
  std::ranges::sort(bad);
  return bad[1] / good[1];
}

}  // namespace

TEST_CASE("a control loop goes on whatever a client in another process does", "[system][pests]") {
  CHECK(p99_beside("good", "shm", Seconds(2.5)) < 0.2);
  for (const std::string& manner : kBadManners) {
    CAPTURE(manner);
    CHECK(p99_beside(manner, "shm", Seconds(2.5)) < 0.2);
  }
}

TEST_CASE("a bad client changes the p99 of a control loop's laps by less than 5 %", "[.][slow][pests]") {
  for (const std::string link : {"shm", "dds"}) {
    for (const std::string& manner : kBadManners) {
      const double factor = slowdown(manner, link);
      std::printf("%s %-10s p99 is %.3f times that beside a good client\n", link.c_str(), manner.c_str(),
                  factor);
      CAPTURE(manner, link);
      CHECK(factor < 1.05);
    }
  }
}
