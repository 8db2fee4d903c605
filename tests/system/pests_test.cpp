// SPDX-License-Identifier: GPL-3.0-or-later
// What a client that behaves badly costs a control loop in another process.
#include <algorithm>
#include <catch2/catch.hpp>
#include <cstdio>
#include <string>
#include <vector>

#include "deployer.hpp"
#include "number_file.hpp"
#include "temp_folder.hpp"

using namespace orca::test;

namespace {

struct Beside {
  Run run;
  std::vector<double> laps;  // times between the laps of the loop, in ascending order [s]
};

// Runs a graph of the loop and a client.
Beside run_beside(const std::string& graph, const std::string& manner, const Words& more, Seconds duration) {
  const TempFolder folder;
  Beside beside{run_deployer(Words{system_graph(graph)} + with_test_plugins() + more +
                                 Words{"--set", "manner=" + manner, "--set", "path=" + folder.file("laps"),
                                       "--until", std::to_string(duration.count()) + " s"},
                             duration + Seconds(20)),
                {}};
  INFO(beside.run.err);
  // A run that ends while one of its processes hangs has failed.
  CHECK((beside.run.exit_code() == 0 || manner == "stop"));
  for (const std::int64_t ns : read_numbers(folder.file("laps")))
    beside.laps.push_back(1e-9 * static_cast<double>(ns));
  std::ranges::sort(beside.laps);
  return beside;
}

double p99(const std::vector<double>& laps) { return laps[laps.size() * 99 / 100]; }

// Runs the loop beside a client, checks that it never stood still, and returns the p99 of the times between its laps [s].
double p99_beside(const std::string& manner, const std::string& link, Seconds duration) {
  CAPTURE(manner, link);
  const auto wanted = static_cast<std::size_t>(duration / Seconds(0.01));
  const std::vector<double> laps = run_beside("pest.xml", manner, {"--set", "link=" + link}, duration).laps;
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

TEST_CASE("whatever a client of images does, the others get theirs whole and without a copy",
          "[system][pests][bulk]") {
  for (const std::string manner : {"good", "exit", "kill", "stop", "deaf", "hoard"}) {
    const auto [run, laps] = run_beside("pest_images.xml", manner, {"--log", "info"}, Seconds(2.5));
    INFO(manner << '\n' << run.err);
    REQUIRE(laps.size() > 200);
    CHECK(p99(laps) < 0.2);
    CHECK(laps.back() < 0.5);
    CHECK_FALSE(run.says("a wrong picture"));
    const std::size_t lent = run.err.rfind(": lent");
    const std::size_t copied = run.err.rfind(": copied");
    REQUIRE(lent != std::string::npos);
    CHECK((copied == std::string::npos || copied < lent));  // at first, before it has the writer's pool
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
