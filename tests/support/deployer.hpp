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

/// Factor on upper bounds of time, which are for the optimised program on a machine that has nothing else to do. Sanitizers make
/// it many times slower, and so does a machine with other work.
inline constexpr double kSlowdown = kSanitized ? 20.0 : 4.0;
/// The same for processor time, which other work does not change.
inline constexpr double kSlowCode = kSanitized ? 20.0 : 1.0;

/// Whether a run over DDS is to end without an alarm: with ThreadSanitizer, plugins stay in memory in a process that has
/// opened Fast DDS, and each is reported as PLUGIN_PINNED.
inline constexpr bool kDdsLetsPluginsGo = !kThreadSanitizer;

/// Whether new code is tried out in a copy of the process before it runs: ThreadSanitizer cannot follow the copy.
inline constexpr bool kTriesInShadow = !kThreadSanitizer;

/// The exit status of a start that a configure() refuses. Under ThreadSanitizer there is no trial before it.
inline constexpr int kRefusedByComponent = kThreadSanitizer ? 3 : 2;

/// A line "arrived NAME x y t", or "arrived NAME x y t ROBOT" where there are several robots.
struct Arrival {
  std::string name;
  double x = 0.0;  ///< [m]
  double y = 0.0;  ///< [m]
  double t = 0.0;  ///< [s] since the start of the run.
  std::string robot;
};

/// The result of a run of the deployer.
struct Run {
  bool ended = false;  ///< False: it was killed when its time was over.
  Ending ending;
  std::string out;
  std::string err;

  [[nodiscard]] int exit_code() const { return ending.exit_code; }
  [[nodiscard]] std::vector<std::string> lines() const;              ///< Lines of stdout.
  [[nodiscard]] std::vector<Arrival> arrivals() const;               ///< In order.
  [[nodiscard]] Words goals() const;                                 ///< Names of the arrivals.
  [[nodiscard]] std::vector<std::string> failures() const;           ///< Whole lines "failed NAME reason".
  [[nodiscard]] std::vector<std::string> contacts() const;           ///< Whole lines.
  [[nodiscard]] std::optional<std::string> trace_hash() const;       ///< If it is the last line.
  [[nodiscard]] bool says(std::string_view text) const;              ///< Whether stderr contains it.
  [[nodiscard]] Words said(std::string_view text) const;             ///< Lines of stderr that contain it.
  [[nodiscard]] std::string line_with(std::string_view text) const;  ///< The first of these; empty: none.

 private:
  [[nodiscard]] std::vector<std::string> lines_with(std::string_view beginning) const;
};

/// Returns the command build/PRESET/bin/deployer with the words as arguments.
[[nodiscard]] Words deployer(const Words& words);

/// Runs orcactl to its end, for at most `limit` times kSlowdown.
[[nodiscard]] Run run_orcactl(const Words& words, Seconds limit = Seconds(20));
/// Returns the command build/PRESET/bin/orcactl with the words as arguments.
[[nodiscard]] Words orcactl(const Words& words);
/// Returns the command build/PRESET/bin/hwprobe with the words as arguments.
[[nodiscard]] Words hwprobe(const Words& words);

/// Returns `--clock virtual`, with an executor that works with the sanitizer of this build.
[[nodiscard]] Words virtual_clock();
[[nodiscard]] Words operator+(Words a, const Words& b);

/// Lets an exchange of code take a third of a second of trial and of probation each.
inline const Words kBriefly{"--tryout", "300 ms", "--probation", "300 ms"};

/// Runs the deployer to its end, for at most `limit` times kSlowdown.
[[nodiscard]] Run run_deployer(const Words& words, Seconds limit = Seconds(30));

/// Runs deployers beside each other, each with a name of its own, and returns their results in the same order. Their wall times say
/// only when they were looked at.
[[nodiscard]] std::vector<Run> run_together(const std::vector<Words>& commands, Seconds limit = Seconds(30));

/// Waits for the end of a program, for at most `limit` times kSlowdown, and returns its result.
[[nodiscard]] Run finish(Subprocess& program, Seconds limit);

/// Returns the path of a file of the source tree.
[[nodiscard]] std::string source_file(std::string_view path);
/// Returns the `--set` option that tells a test graph where the plugins of the tests are.
[[nodiscard]] Words with_test_plugins();
/// Returns the path of a graph in tests/data/graphs/system.
[[nodiscard]] std::string system_graph(std::string_view name);

[[nodiscard]] std::vector<std::string> split_lines(std::string_view text);
/// Returns the number of the first line of a file that holds a text; 0 if none does.
[[nodiscard]] std::string line_of(const std::string& file, std::string_view text);

}  // namespace orca::test
