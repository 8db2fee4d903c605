// SPDX-License-Identifier: GPL-3.0-or-later
// Additional permission: LICENSES/Orca-plugin-exception.txt
#include "difference.hpp"

#include <cinttypes>
#include <cstdio>
#include <optional>
#include <string>

#include "folders.hpp"
#include "orca/base/text.hpp"
#include "orca/batch/difference.hpp"
#include "orca/batch/results_difference.hpp"
#include "orca/batch/store.hpp"

namespace orca::simbatch {
namespace {

// What depends on addresses may come out the same by chance.
constexpr int kMostPairs = 5;

// The results of one batch, and what its runs need to be made again.
struct Side {
  std::string name;  // as the user gave it
  std::unique_ptr<batch::Store> store{};
  std::optional<batch::Experiment> experiment{};
  batch::BatchOptions options{};
};

Result<Side> side(const std::string& folder) {
  Result<std::unique_ptr<batch::Store>> store = open_results(folder);
  if (!store) return store.error();
  return Side{folder, std::move(store).value()};
}

// Finds out how the runs of a batch are made.
Status prepare(const Options& options, Side& side) {
  const batch::Origin origin = side.store->origin();
  xml::Diagnostics diagnostics;
  std::optional<batch::Experiment> experiment = batch::read_experiment(origin.file, diagnostics);
  if (!experiment)
    return fail(Code::failed_precondition, "the experiment of " + side.name + ", " + in_quotes(origin.file) +
                                               ", cannot be read any more");
  if (batch::identity_of(*experiment) != side.store->identity())
    return fail(
        Code::failed_precondition,
        in_quotes(origin.file) + ", or a graph that it names, was changed since " + side.name + " was made");
  std::vector<std::string> plugins = origin.plugins;
  plugins.insert(plugins.end(), options.plugins.begin(), options.plugins.end());
  side.options = with_plugins(options.batch, plugins);
  side.experiment = std::move(experiment);
  return ok();
}

Result<batch::RunAgain> again(const Side& side, const batch::Row& row) {
  const auto number = side.experiment->number_of(row.variant, row.world, row.seed);
  if (!number)
    return fail(Code::failed_precondition, "the experiment of " + side.name + " has this run no more");
  return batch::RunAgain{*side.experiment, *number, side.options};
}

std::string hash_text(const std::string& hash) { return hash.empty() ? "none" : hash; }

// Returns what it means that two runs are the same now.
std::string sameness(const batch::PairOfRuns& pair, const batch::Row& a, const batch::Row& b, const Side& one,
                     const Side& other) {
  if (pair.first_hash != pair.second_hash)
    return "made again, they differ in the time of a delivery by less than 1 us, or in a value that the text "
           "of an object does not "
           "show";
  std::string whose = "neither of them";
  if (pair.first_hash == a.outcome.trace_hash) whose = one.name;
  if (pair.first_hash == b.outcome.trace_hash) whose = other.name;
  return "made again with the programs and files of now, all deliveries are the same: trace_hash " +
         hash_text(pair.first_hash) + ", that of " + whose +
         ". A program, a plugin or a file was changed meanwhile; or the run depends on something that did "
         "not change just now";
}

// Returns the first delivery in which the runs of two batches differ, or what there is instead.
std::string first_delivery(const Side& one, const batch::Row& a, const Side& other, const batch::Row& b) {
  const Result<batch::RunAgain> first = again(one, a);
  if (!first) return first.error().message;
  const Result<batch::RunAgain> second = again(other, b);
  if (!second) return second.error().message;
  std::string last;
  for (int i = 0; i < kMostPairs; ++i) {
    const Result<batch::PairOfRuns> pair = batch::make_both(*first, *second, [] { return false; });
    if (!pair) return "made again, " + pair.error().message;
    if (pair->difference)
      return "first delivery that differs: " + pair->difference->text(one.name, other.name);
    last = sameness(*pair, a, b, one, other);
  }
  return last;
}

void say_counts(const batch::ResultsDifference& found, const Side& one, const Side& other) {
  std::printf("%zu of %zu runs that both have differ\n", found.different, found.in_both);
  for (const auto& [count, name] :
       {std::pair(found.only_first, one.name), std::pair(found.only_second, other.name)})
    if (count > 0) std::printf("%zu runs are in %s only\n", count, name.c_str());
}

// Says which plugins, files and programs were others.
void say_inputs(const Side& one, const Side& other) {
  const batch::Inputs known = one.store->inputs();
  std::vector<std::string> names;
  for (const auto& [name, content] : other.store->inputs())
    if (const auto found = known.find(name); found != known.end() && found->second != content)
      names.push_back(name);
  if (!names.empty()) std::printf("not the same for both: %s\n", listed(names).c_str());
}

void say_first(const Options& options, const std::pair<batch::Row, batch::Row>& rows, Side& one,
               Side& other) {
  const auto& [a, b] = rows;
  std::printf("the first is variant %s, world %s, seed %" PRIu64 ":\n", a.variant.c_str(), a.world.c_str(),
              a.seed);
  for (const std::string& column : batch::columns_that_differ(a.outcome, b.outcome, one.name, other.name))
    std::printf("  %s\n", column.c_str());
  std::fflush(stdout);
  if (a.outcome.trace_hash == b.outcome.trace_hash) {
    std::printf("  every delivery is the same: what differs is how the run was measured\n");
    return;
  }
  for (Side* const side : {&one, &other})
    if (const Status prepared = prepare(options, *side); !prepared.ok()) {
      std::printf("  it cannot be made again: %s\n", prepared.error().message.c_str());
      return;
    }
  std::printf("  %s\n", first_delivery(one, a, other, b).c_str());
}

}  // namespace

ExitCode diff(const Options& options) {
  Result<Side> one = side(options.subject);
  if (!one) return refuse(one.error());
  Result<Side> other = side(options.others.front());
  if (!other) return refuse(other.error());
  const Result<batch::ResultsDifference> found = batch::compare_results(*one->store, *other->store);
  if (!found) return refuse(found.error());
  if (found->is_empty()) {
    std::printf("all %zu runs are the same\n", found->in_both);
    return ExitCode::done;
  }
  say_counts(*found, *one, *other);
  say_inputs(*one, *other);
  if (found->first) say_first(options, *found->first, *one, *other);
  return ExitCode::different;
}

}  // namespace orca::simbatch
