// SPDX-License-Identifier: GPL-3.0-or-later
// Additional permission: LICENSES/Orca-plugin-exception.txt
#include "status.hpp"

#include <algorithm>
#include <cstddef>
#include <map>
#include <optional>
#include <vector>

#include "orca/base/json.hpp"
#include "orca/batch/report.hpp"

namespace orca::simbatch {
namespace {

constexpr std::size_t kMostFailures = 500;

struct Tally {
  std::size_t done = 0;
  std::map<std::string, std::size_t> endings;
};

template <class Named>
std::optional<std::size_t> index_of(const std::vector<Named>& all, const std::string& name) {
  const auto found = std::ranges::find(all, name, &Named::name);
  if (found == all.end()) return std::nullopt;
  return static_cast<std::size_t>(found - all.begin());
}

std::optional<batch::Run> run_of(const batch::Experiment& experiment, const batch::Row& row) {
  const std::optional<std::size_t> variant = index_of(experiment.variants, row.variant);
  const std::optional<std::size_t> world = index_of(experiment.worlds, row.world);
  if (!variant || !world) return std::nullopt;
  return batch::Run{*variant, *world, row.seed};
}

// Returns the number of a run in its experiment, which stays whatever results come.
std::size_t number_of(const batch::Experiment& experiment, const batch::Run& run) {
  const auto seed = std::ranges::find(experiment.seeds, run.seed) - experiment.seeds.begin();
  return (run.variant * experiment.worlds.size() + run.world) * experiment.seeds.size() +
         static_cast<std::size_t>(seed);
}

void write(const batch::Experiment& experiment, const batch::Row& row, JsonWriter& json) {
  json.begin_object();
  json.member("variant", row.variant);
  json.member("world", row.world);
  json.member("seed", row.seed);
  json.member("ending", name_of(row.outcome.ending));
  json.member("failure", name_of(row.outcome.failure));
  json.member("reason", row.outcome.reason);
  json.member("time", row.outcome.time);
  if (const std::optional<batch::Run> run = run_of(experiment, row)) {
    json.member("run", number_of(experiment, *run));
    json.member("command", batch::replay_command(experiment, *run));
    json.member("watch", batch::watch_command(experiment, *run));
  }
  json.end();
}

void write(const batch::Experiment& experiment, const std::map<std::string, Tally>& tallies,
           JsonWriter& json) {
  json.key("variants").begin_array();
  for (const batch::Variant& variant : experiment.variants) {
    const auto found = tallies.find(variant.name);
    const Tally tally = found == tallies.end() ? Tally{} : found->second;
    json.begin_object();
    json.member("name", variant.name);
    json.member("runs", experiment.run_count() / experiment.variants.size());
    json.member("done", tally.done);
    json.key("endings").begin_object();
    for (const auto& [ending, count] : tally.endings) json.member(ending, count);
    json.end();
    json.end();
  }
  json.end();
}

}  // namespace

Result<std::string> status_json(const batch::Experiment& experiment, const batch::Store& store) {
  std::map<std::string, Tally> tallies;
  std::vector<batch::Row> failed;
  std::size_t done = 0;
  std::size_t failures = 0;
  const Status read = store.for_each([&](const batch::Row& row) {
    ++done;
    ++tallies[row.variant].done;
    ++tallies[row.variant].endings[name_of(row.outcome.ending)];
    if (row.outcome.ending == batch::Ending::success) return;
    if (++failures <= kMostFailures) failed.push_back(row);
  });
  if (!read.ok()) return read.error();
  JsonWriter json;
  json.begin_object();
  json.member("experiment", experiment.name);
  json.member("file", store.origin().file);
  json.member("runs", experiment.run_count());
  json.member("done", done);
  write(experiment, tallies, json);
  json.member("failures", failures);
  json.key("failed").begin_array();
  for (const batch::Row& row : failed) write(experiment, row, json);
  json.end();
  json.end();
  return json.text();
}

}  // namespace orca::simbatch
