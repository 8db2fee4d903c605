// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "subprocess.hpp"

namespace orca::test {

using Words = std::vector<std::string>;

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
inline constexpr bool kSanitized = true;
#else
inline constexpr bool kSanitized = false;
#endif
#if defined(__SANITIZE_THREAD__)
inline constexpr bool kThreadSanitizer = true;
#else
inline constexpr bool kThreadSanitizer = false;
#endif

/// Upper bounds are for the optimised program; sanitizers make it many times slower.
inline constexpr double kSlowdown = kSanitized ? 20.0 : 1.0;

/// "arrived NAME x y t"
struct Arrival {
  std::string name;
  double x = 0.0;  ///< [m]
  double y = 0.0;  ///< [m]
  double t = 0.0;  ///< [s] since the start of the run.
};

/// What a run of the deployer left behind.
struct Run {
  bool ended = false;  ///< Else it was killed when its time was over.
  Ending ending;
  std::string out;
  std::string err;

  [[nodiscard]] int exit_code() const { return ending.exit_code; }
  [[nodiscard]] std::vector<std::string> lines() const;         ///< Of stdout.
  [[nodiscard]] std::vector<Arrival> arrivals() const;          ///< In order.
  [[nodiscard]] std::vector<std::string> contacts() const;      ///< Whole lines.
  [[nodiscard]] std::optional<std::string> trace_hash() const;  ///< If it is the last line.
  [[nodiscard]] bool says(std::string_view text) const;         ///< On stderr.
};

/// build/PRESET/bin/deployer, then the words.
[[nodiscard]] Words deployer(const Words& words);

/// `--clock virtual`, with the executor that the sanitizer of this build can follow.
[[nodiscard]] Words virtual_clock();
[[nodiscard]] Words operator+(Words a, const Words& b);

/// Runs the deployer to its end, at most `limit` (stretched under sanitizers).
[[nodiscard]] Run run_deployer(const Words& words, Seconds limit = Seconds(30));

/// What is left of a program after `limit`, as a Run.
[[nodiscard]] Run finish(Subprocess& program, Seconds limit);

/// A file of the source tree.
[[nodiscard]] std::string source_file(std::string_view path);
/// Where the plugins of the tests are, and the `--set` that tells a test graph.
[[nodiscard]] Words with_test_plugins();
/// A graph of tests/data/graphs/system.
[[nodiscard]] std::string system_graph(std::string_view name);

[[nodiscard]] std::vector<std::string> split_lines(std::string_view text);

}  // namespace orca::test
