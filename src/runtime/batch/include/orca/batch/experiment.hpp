// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "orca/base/time.hpp"
#include "orca/batch/referee.hpp"
#include "orca/batch/statistics/finding.hpp"
#include "orca/xml/diagnostics.hpp"

namespace orca::batch {

/// A setting for a graph, as deployer --set takes it, and where the experiment gives it.
struct Setting {
  std::string name;   ///< An argument of the graph, or "COMPONENT.PARAM".
  std::string value;  ///< A path is absolute.
  xml::Position position;

  /// Returns "NAME=VALUE".
  [[nodiscard]] std::string text() const { return name + "=" + value; }
  /// Returns the same with an absolute path written from a folder on, so that it is the same wherever the folder lies.
  [[nodiscard]] std::string text_from(const std::string& folder) const;
};

/// A range from which a tuner draws the value of a setting. A plain value.
struct SettingRange {
  std::string name;   ///< The setting.
  double from = 0.0;  ///< In the SI unit.
  double to = 0.0;    ///< Likewise, above `from`.
  std::string unit;   ///< The SI unit; empty: a plain number.
  bool by_factors =
      false;  ///< Equal factors are equally likely, not equal differences; `from` is above 0 then.
  xml::Position position{};
};

/// One of the things that are compared: a graph, and what is set in it.
struct Variant {
  std::string name;
  std::string graph;  ///< Path.
  std::vector<Setting> settings;
  xml::Position position;
  std::vector<std::string>
      profiles{};          ///< The graph's, in the order in which they are merged; none: its default_profile.
  double computing = 1.0;  ///< Its laps take this many times as long as its graph says.
  std::vector<SettingRange> ranges{};  ///< Settings that a tuner may choose.
};

/// A component that fails on purpose in the runs of a world. A plain value.
struct Failing {
  std::string component;
  std::string how;                   ///< A name of deployer --fail.
  Duration at{0};                    ///< [s of the run's clock] since the components began to work.
  std::optional<Duration> latest{};  ///< If given, each seed draws its time from `at` up to this one.
  xml::Position position{};
  /// The one of many `<worlds>` for which the times are drawn, so that each has its own; empty: a single `<world>`.
  std::string world{};

  /// Returns when it fails in the runs with a seed.
  [[nodiscard]] Duration time(std::uint64_t seed) const;
  /// Returns what deployer --fail takes, "pilot=throw@12.345s".
  [[nodiscard]] std::string order(std::uint64_t seed) const;
  /// Returns the same with the range of the time, "pilot=throw@10s..60s".
  [[nodiscard]] std::string text() const;
};

/// One of the places in which each variant is tried.
struct World {
  std::string name;
  std::vector<Setting> settings;
  xml::Position position;
  std::optional<double> reference{};  ///< [m] Length of the way that a run in it is compared with.
  std::vector<Goal> goals{};          ///< Instead of those of the experiment; empty: those.
  std::string family{};               ///< Worlds of one kind; its own name if it is the only one.
  std::vector<Failing> failing{};     ///< Components that fail in it, each once at most.
};

/// The budget of a tuner, the same for each variant, and the worlds that it may see. A plain value.
struct Tuning {
  std::size_t draws = 0;      ///< Number of each variant, with the declared values as the first.
  std::uint64_t seed = 1;     ///< The seed of the draws.
  std::vector<World> worlds;  ///< None of those in which variants are compared.
};

/// A question about two variants, declared before anything runs. A plain value.
struct Contrast {
  std::string first, second;  ///< Variants.
  std::string metric;
  Asked asked{};
  std::string margin{};  ///< As it is written, "2 s"; empty: none.
  xml::Position position{};

  /// Returns "VfhPlus - LaserAvoid, time: equal within 2 s".
  [[nodiscard]] std::string text() const;
};

/// One run of an experiment: a variant in a world with a seed.
struct Run {
  std::size_t variant;  ///< Index.
  std::size_t world;    ///< Index.
  std::uint64_t seed;
};

/// A comparison: each variant is run in each world with each seed. A plain value.
struct Experiment {
  std::string name;
  std::string file;               ///< Path.
  std::vector<Setting> settings;  ///< For all runs.
  std::vector<Goal> goals{};      ///< Each robot's in their order; none: components' own word counts.
  /// Components' words are about a task: a goal on the way may be given up, but the task must be done. Otherwise each word is about
  /// one of the goals, in their order.
  bool has_task = false;
  std::vector<Variant> variants;
  std::vector<World> worlds;
  std::vector<std::uint64_t> seeds;
  std::vector<std::string> metrics;  ///< In which variants are compared.
  std::vector<Contrast> contrasts;  ///< If there are none, all pairs of variants are compared in all metrics.
  Duration until{0};                ///< Limit of each run [s of its clock].
  Duration limit{0};                ///< Limit of each run [s of the wall clock].
  std::uint64_t memory_limit = 0;   ///< [bytes] of address space of each run.
  std::vector<std::string>
      tables{};                    ///< Paths of the tables of references and of the settings that were read.
  std::optional<Tuning> tuning{};  ///< The budget of `simbatch tune`; no other run depends on it.

  [[nodiscard]] std::size_t run_count() const { return variants.size() * worlds.size() * seeds.size(); }
  /// Returns a run. Those that differ in the variant only stand together, so that what a stopped batch has finished can be
  /// compared in pairs.
  /// @pre  number < run_count().
  [[nodiscard]] Run run(std::size_t number) const;
  /// Returns the number of a run; nothing if the experiment has none of these names.
  [[nodiscard]] std::optional<std::size_t> number_of(const std::string& variant, const std::string& world,
                                                     std::uint64_t seed) const;
  /// Returns the settings of a run, the more special ones last: of all, of the world, of the variant.
  [[nodiscard]] std::vector<std::string> settings_of(const Run& run) const;
  /// Returns the goals that a run is judged by.
  [[nodiscard]] const std::vector<Goal>& goals_of(const Run& run) const;
};

/// Returns what an experiment asks: its contrasts, or the difference of all pairs of variants in all of its metrics.
[[nodiscard]] std::vector<Contrast> questions_of(const Experiment& experiment);

/// Reads an experiment. It does not look at the graphs.
/// @param diagnostics  receives everything that is wrong with it (docs/comparing.md).
/// @return the experiment, if nothing is.
/// @thread  no shared state; any thread.
[[nodiscard]] std::optional<Experiment> read_experiment(const std::string& file,
                                                        xml::Diagnostics& diagnostics);

/// Reads as much of an experiment as there is, for checks that find more than the first errors. It has a world and a seed at
/// least, and each of its variants has a graph.
/// @return nothing if the file holds no experiment at all.
[[nodiscard]] std::optional<Experiment> read_parts(const std::string& file, xml::Diagnostics& diagnostics);

/// Does the same as read_experiment() for a text in memory; relative paths start at the folder of `file`.
[[nodiscard]] std::optional<Experiment> read_experiment(std::string_view text, const std::string& file,
                                                        xml::Diagnostics& diagnostics);

/// Returns a text by which the results of an experiment are known. It changes with its name, its limit of time, its settings, and the
/// names, graphs' files and settings of its variants; not with more worlds or seeds, which --resume adds, nor with plugins and files that
/// the graphs name.
[[nodiscard]] std::string identity_of(const Experiment& experiment);

}  // namespace orca::batch
