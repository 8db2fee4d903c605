// SPDX-License-Identifier: GPL-3.0-or-later
// Runs the benchmarks on one core and prints one table. Each row compares an operation of Orca with the barest
// reference that does the same, measured in the same run, in alternating samples. The options are those of
// Google Benchmark, e.g. --benchmark_filter=push and --benchmark_out=FILE. With --gate the exit status is 1 if
// a target is missed.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <cstring>
#include <iostream>

#include "benchmarks.hpp"
#include "processors.hpp"
#include "table.hpp"

namespace {

// Google Benchmark's own report would average over both sides of each comparison.
class Progress final : public benchmark::BenchmarkReporter {
 public:
  bool ReportContext(const Context&) override { return true; }
  void ReportRuns(const std::vector<Run>& runs) override {
    for (const Run& run : runs) {
      std::cerr << "bench: " << run.run_name.function_name;
      if (run.error_occurred) std::cerr << ": " << run.error_message;
      std::cerr << '\n';
    }
  }
};

bool take_option(int& argc, char** argv, const char* option) {
  char** const end =
      std::remove_if(argv + 1, argv + argc, [&](const char* a) { return std::strcmp(a, option) == 0; });
  const bool found = end != argv + argc;
  argc = static_cast<int>(end - argv);
  return found;
}

}  // namespace

int main(int argc, char** argv) {
  using namespace orca::bench;
  const bool gate = take_option(argc, argv, "--gate");
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 2;
  at_start().one().use();
  register_hand_over();
  register_push();
  register_fan_out();
  register_isolation();
  register_query();
  register_shm();
  register_dds();
  register_start();
  register_throughput();
  register_graph();
  register_sim_cast();
  register_sim_world();
  register_sim_scaling();
  register_stalling_device();
  register_planner();
  register_collision();
  Progress progress;
  benchmark::RunSpecifiedBenchmarks(&progress);
  const int missed = print_table(std::cout, rows());
  if (missed > 0) std::cout << missed << (missed == 1 ? " target is" : " targets are") << " missed\n";
  return gate && missed > 0 ? 1 : 0;
}
