// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <cstddef>
#include <map>
#include <string>
#include <vector>

#include "orca/base/result.hpp"
#include "orca/batch/experiment.hpp"
#include "orca/batch/statistics/verdict.hpp"
#include "orca/batch/store.hpp"
#include "results/metric.hpp"

namespace orca::batch {

/// A metric of a variant's runs.
struct Summary {
  std::size_t runs = 0;      ///< Those that have it.
  Scope scope;               ///< Their worlds.
  Estimate mean;             ///< With an interval over worlds, or over the seeds of one or two.
  double middle_half = 0.0;  ///< Mean of the middle half of the runs.
};

/// The outcomes of the runs of a variant. Runs of a world with equal trace hashes are one run.
struct VariantResult {
  std::string name;
  std::size_t runs = 0;
  std::map<Ending, std::size_t> endings;
  std::map<Failure, std::size_t> failures;
  std::size_t claim_wrongly = 0;             ///< Runs in which a goal was claimed where the robot was not.
  std::size_t do_not_claim = 0;              ///< Runs in which a goal that was reached was not claimed.
  std::map<std::string, Summary> metrics{};  ///< By name; without those that no run has.
};

/// The answer to a question about two variants.
struct Difference {
  Contrast asked;
  Finding finding;          ///< Over pairs of runs in the same world with the same seed.
  double adjusted_p = 1.0;  ///< For all tests that could find something, by Holm's method.
  double improvement =
      0.5;  ///< Probability that a run of the first is better than one of the second in the same world.
  Verdict verdict;
};

/// Returns what distinguishes a run from others; empty: nothing does, so it counts by itself. Where robots drove, it is their true motion to the last
/// bit: noise of sensors that moves no robot makes another trace, and no other run. Else it is the trace.
[[nodiscard]] std::string identity_of(const Outcome& outcome);

/// Returns whether both answer the same question.
[[nodiscard]] bool same_question(const Difference& one, const Difference& other);

/// Seeds that gave fewer runs than there are seeds: in some the robots drove the same to the last bit, or the traces are equal, as with
/// other seeds or in other worlds.
struct SameRuns {
  std::vector<std::string> variants;
  std::vector<std::string> worlds;  ///< In each of them.
  std::size_t seeds = 0;
  std::size_t runs = 0;
};

/// The results in the worlds of one family.
struct FamilyResult {
  std::string name;
  std::size_t worlds = 0;
  std::map<std::string, Summary> success;  ///< By variant.
  std::vector<Difference> differences;  ///< As those of a batch; the p-values are adjusted over all families.
};

/// A difference that is established in one family of worlds, and in another one the other way round.
struct Reversal {
  Difference more, less;  ///< Above and below 0.
  std::string more_family, less_family;
};

/// The results of a batch, and what may be claimed of them.
struct BatchResult {
  std::vector<VariantResult> variants;  ///< By name.
  std::vector<std::string> worlds;      ///< By name.
  std::vector<SameRuns> same_runs;
  /// Number of successes and runs by variant and world.
  std::map<std::pair<std::string, std::string>, std::pair<std::size_t, std::size_t>> matrix;
  /// One for each contrast that has a pair of runs. None of them that a reversal contradicts is established.
  std::vector<Difference> differences;
  std::vector<Contrast> unanswered;    ///< Those that no pair of runs answers.
  std::vector<FamilyResult> families;  ///< By name; none if all worlds are of one.
  std::vector<Reversal> reversals;
};

/// The question that rows answer.
struct Question {
  std::vector<Contrast> contrasts;
  std::map<std::string, std::string> families;  ///< By world; one that is not there is of no family.
};

/// @errors  those of the statistics, if there are no rows; invalid_argument if there is no such metric.
/// @thread  a pure function; any thread.
[[nodiscard]] Result<BatchResult> compare(const std::vector<Row>& rows, const Question& question);

}  // namespace orca::batch
