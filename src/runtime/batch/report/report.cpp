// SPDX-License-Identifier: LGPL-3.0-or-later
#include "orca/batch/report.hpp"

#include <algorithm>
#include <map>
#include <utility>

#include "comparison.hpp"
#include "declared.hpp"
#include "document.hpp"
#include "families.hpp"
#include "numbers.hpp"
#include "orca/base/text.hpp"
#include "orca/xml/number.hpp"
#include "plots.hpp"
#include "processor_time.hpp"
#include "provenance.hpp"

namespace orca::batch {
namespace {

constexpr std::size_t kShownWorlds = 6;
constexpr std::size_t kListedWorlds = 12;  // as many as a reader looks at one by one
constexpr std::size_t kShownFailures = 3;  // of a variant and kind

std::string settings_text(const Experiment& experiment, const std::vector<Setting>& settings,
                          const std::vector<std::string>& profiles = {}) {
  std::string text = profiles.empty() ? "" : "profile " + joined(profiles, " ");
  for (const Setting& setting : settings)
    text += (text.empty() ? "" : ", ") + setting.name + "=" + from_folder_of(experiment, setting.value);
  return text;
}

// Puts worlds in the order of the experiment: posts_2 before posts_10.
void put_in_order(const Experiment& experiment, std::vector<std::string>& worlds) {
  std::map<std::string, std::size_t> places;
  for (const World& world : experiment.worlds) places.emplace(world.name, places.size());
  std::ranges::stable_sort(worlds, {}, [&](const std::string& world) {
    const auto known = places.find(world);
    return known == places.end() ? places.size() : known->second;
  });
}

class Writer {
 public:
  Writer(const Experiment& experiment, const Store& store, const std::vector<Row>& rows,
         const BatchResult& result)
      : experiment_(experiment), store_(store), rows_(rows), result_(result) {}

  Document write() {
    document_.title = "Comparison: " + experiment_.name;
    if (!result_.reversals.empty()) document_.add(Heading{"Read this first"});
    for (const Reversal& reversal : result_.reversals) document_.add(Paragraph{line_of(reversal) + "."});
    introduce();
    success();
    claims();
    add_families(rows_, families_of(experiment_), result_, document_);
    metrics();
    worlds();
    distributions();
    tracks();
    failures();
    add_declarations(store_.declarations(), document_);
    add_processor_time(experiment_, rows_, document_);
    add_provenance(experiment_, store_, document_);
    return std::move(document_);
  }

 private:
  void introduce() {
    document_.add(Paragraph{
        std::to_string(rows_.size()) + " of " + std::to_string(experiment_.run_count()) +
        " runs, each in simulated time and at most " + xml::number_text(to_seconds(experiment_.until)) +
        " s long. All variants met the same worlds with the same seeds. The figures come from Orca's "
        "simulator: they belong beside others of the same simulator, not beside those of another one."});
    Table table{{"variant", "graph", "settings"}, {}};
    for (const Variant& variant : experiment_.variants)
      table.rows.push_back({variant.name, from_folder_of(experiment_, variant.graph),
                            settings_text(experiment_, variant.settings, variant.profiles)});
    document_.add(std::move(table));
    warn_of_dependent();
    if (!experiment_.settings.empty())
      document_.add(Paragraph{"Settings of all runs: " + settings_text(experiment_, experiment_.settings)});
  }

  // Names each variant that was not the same when it was made again, with the first run that was not.
  void warn_of_dependent() {
    std::map<std::string, std::pair<std::size_t, std::size_t>>
        repeated;  // number of runs, and of those that differed
    std::map<std::string, RepeatRow> first;
    for (const RepeatRow& row : store_.repeats()) {
      auto& [all, different] = repeated[row.variant];
      ++all;
      if (row.repeat.difference.empty()) continue;
      ++different;
      first.try_emplace(row.variant, row);
    }
    for (const auto& [variant, row] : first)
      document_.add(Paragraph{"Variant " + variant + " depends on more than world and seed: of " +
                              std::to_string(repeated[variant].first) + " runs that were made twice " +
                              std::to_string(repeated[variant].second) + " differed, first that in " +
                              row.world + " with seed " + std::to_string(row.seed) +
                              ". Its figures are those of this machine and this time. " +
                              row.repeat.difference});
  }

  void success() {
    document_.add(Heading{"Success"});
    Table table{{"variant", "runs", "success (95 %)", "others", "false words"}, {}};
    const Metric& metric = *find_metric("success");
    for (const VariantResult& variant : result_.variants) {
      std::string others;
      for (const auto& [ending, count] : variant.endings)
        if (ending != Ending::success && count > 0)
          others += (others.empty() ? "" : ", ") + std::to_string(count) + " " + name_of(ending);
      table.rows.push_back({variant.name, std::to_string(variant.runs),
                            estimate_text(variant.metrics.at("success").mean, metric), others,
                            false_words_of(variant)});
    }
    document_.add(std::move(table));
    for (const std::string& line : lines_on_runs(experiment_, rows_, result_))
      document_.add(Paragraph{line + "."});
    judge();
    document_.add(Paragraph{intervals_text()});
  }

  // Adds who judges, and by which goals.
  void judge() {
    const bool own = std::ranges::any_of(experiment_.worlds, [](const World& w) { return !w.goals.empty(); });
    if (experiment_.goals.empty() && !own) {
      document_.add(Paragraph{
          "The experiment declares no goals, so a success is the components' own word: they said that "
          "all goals were reached, and no robot touched anything."});
      return;
    }
    std::vector<std::string> goals;
    for (const Goal& goal : experiment_.goals) goals.push_back(goal_text(goal));
    if (own) goals.emplace_back("some worlds have goals of their own instead");
    document_.add(
        Paragraph{"A success reaches all goals of the experiment by the true poses of its robots, whatever "
                  "components say of "
                  "them, and touches nothing. Goals: " +
                  joined(goals, "; ") + "."});
  }

  // Returns how the intervals of the means of variants are made.
  [[nodiscard]] std::string intervals_text() const {
    if (!Scope{result_.worlds.size()}.over_worlds())
      return "Intervals of 95 % are over the seeds" + Scope{result_.worlds.size()}.text() +
             ": they say nothing of other worlds.";
    return "Intervals of 95 % are over worlds: each world is one value, the mean of its seeds.";
  }

  void claims() {
    if (result_.differences.empty() && result_.unanswered.empty()) return;
    document_.add(Heading{"What may be claimed"});
    for (const Contrast& contrast : result_.unanswered) document_.add(Paragraph{line_of(contrast) + "."});
    Table table{
        {"metric", "question", "claim", "difference (95 %)", "p", "test", "better in", "pairs", "needed"},
        {}};
    for (const Difference& one : result_.differences) {
      const Metric& metric = *find_metric(one.asked.metric);
      table.rows.push_back({title_of(metric), question_text(one.asked),
                            claim_text(one) + families_text(one, result_),
                            estimate_text(one.finding.difference, metric), p_text(one.adjusted_p),
                            test_text(one.finding), value_text(one.improvement, *find_metric("success")),
                            std::to_string(one.finding.runs), needed_text(one.finding)});
    }
    document_.add(std::move(table));
    document_.add(Paragraph{
        "Paired by world and seed; time only where both succeed. From three worlds on a pair of variants has "
        "one "
        "difference for each world, the mean of its seeds; in one or two worlds it has one for each run, and "
        "the "
        "claim says nothing of others. The p-value is that of a permutation test that flips the signs of "
        "these "
        "differences, or of Student's t test where there are too few for that, adjusted by Holm's method for "
        "the "
        "number of tests with runs and worlds enough. \"Better in\" is the probability that a run of the "
        "first is "
        "better than one of the second in the same world. A difference is called established only with at "
        "least 9 "
        "runs of each, p of 0.05 or less, and an interval without 0. \"Not established\" does not mean "
        "equal. \"Not "
        "worse\" and \"equal\" need an interval within the margin and one-sided tests of 2.5 %. The last "
        "column "
        "says how many worlds (or runs, where the worlds are fixed) show the claim with a probability of 80 "
        "%, if they "
        "spread as these do, and if the true difference is the observed one, or 0 where there is a margin."});
  }

  void metrics() {
    document_.add(Heading{"All metrics"});
    Table table{{"metric"}, {}};
    for (const VariantResult& variant : result_.variants) table.head.push_back(variant.name);
    table.head.emplace_back("what it is");
    for (const Metric& metric : all_metrics()) {
      std::vector<std::string> row{title_of(metric)};
      bool is_known = false;
      for (const VariantResult& variant : result_.variants) {
        const auto found = variant.metrics.find(metric.name);
        is_known = is_known || found != variant.metrics.end();
        row.push_back(found == variant.metrics.end() ? "" : summary_text(found->second, metric));
      }
      row.push_back(metric.text + (metric.of_successes ? " Of successes only." : ""));
      if (is_known) table.rows.push_back(std::move(row));
    }
    document_.add(std::move(table));
    document_.add(Paragraph{
        "Means with intervals of 95 %; after the semicolon the mean of the middle half of the runs."});
    name_missing();
  }

  // Names the metrics that no run has, by what they need.
  void name_missing() {
    std::map<std::string, std::vector<std::string>> missing;
    for (const Metric& metric : all_metrics())
      if (std::ranges::none_of(rows_, [&](const Row& row) { return metric.of(row.outcome).has_value(); }))
        missing[metric.needs].push_back(metric.name);
    for (const auto& [needs, names] : missing)
      document_.add(Paragraph{"No run has " + listed(names) + ": it takes " + needs + "."});
  }

  static std::string summary_text(const Summary& summary, const Metric& metric) {
    const std::string mean = estimate_text(summary.mean, metric);
    return metric.is_success() ? mean : mean + "; " + value_text(summary.middle_half, metric);
  }

  void worlds() {
    document_.add(Heading{"World by world"});
    add_world_table("successes", [&](const std::string& variant, const std::string& world) {
      const auto found = result_.matrix.find({variant, world});
      if (found == result_.matrix.end()) return std::string();
      return std::to_string(found->second.first) + " of " + std::to_string(found->second.second);
    });
    if (result_.worlds.size() > kListedWorlds) return;
    for (const std::string& name : experiment_.metrics) {
      const Metric& metric = *find_metric(name);
      if (metric.is_success()) continue;
      add_world_table(title_of(metric), [&](const std::string& variant, const std::string& world) {
        return spread_text(values_of(metric, variant, world), metric);
      });
    }
    document_.add(Paragraph{"Means over the seeds, with the smallest and the largest value."});
  }

  // Adds a table with a row for each world and a column for each variant.
  template <class CellText>
  void add_world_table(const std::string& what, const CellText& text_of) {
    Table table{{"world: " + what}, {}};
    for (const VariantResult& variant : result_.variants) table.head.push_back(variant.name);
    for (const std::string& world : result_.worlds) {
      std::vector<std::string> row{world};
      for (const VariantResult& variant : result_.variants) row.push_back(text_of(variant.name, world));
      table.rows.push_back(std::move(row));
    }
    document_.add(std::move(table));
  }

  [[nodiscard]] std::vector<double> values_of(const Metric& metric, const std::string& variant,
                                              const std::string& world) const {
    std::vector<double> values;
    for (const Row& row : rows_)
      if (row.variant == variant && row.world == world)
        if (const std::optional<double> value = metric.of(row.outcome)) values.push_back(*value);
    return values;
  }

  [[nodiscard]] std::vector<std::string> variant_names() const {
    std::vector<std::string> names;
    for (const VariantResult& variant : result_.variants) names.push_back(variant.name);
    return names;
  }

  [[nodiscard]] std::size_t number_of(const std::string& variant) const {
    return static_cast<std::size_t>(std::ranges::find(result_.variants, variant, &VariantResult::name) -
                                    result_.variants.begin());
  }

  void distributions() {
    std::vector<Series> times;
    std::vector<Series> speeds;
    for (const VariantResult& variant : result_.variants) {
      times.push_back({variant.name, {}, variant.runs});
      speeds.push_back({variant.name, {}, variant.runs});
    }
    for (const Row& row : rows_) {
      const Outcome& outcome = row.outcome;
      if (outcome.ending != Ending::success) continue;
      times[number_of(row.variant)].values.push_back(outcome.time);
      if (outcome.measures.way && outcome.time > 0.0)
        speeds[number_of(row.variant)].values.push_back(*outcome.measures.way / outcome.time);
    }
    if (std::ranges::any_of(times, [](const Series& one) { return !one.values.empty(); })) {
      document_.add(Heading{"Times and speeds"});
      document_.add(Figure{{distribution_plot("time until the last goal [s]", times)},
                           "Share of the runs that were done by then. Runs without success never are."});
    }
    if (std::ranges::any_of(speeds, [](const Series& one) { return !one.values.empty(); }))
      document_.add(Figure{{distribution_plot("mean speed of a success [m/s]", speeds)},
                           "Share of the runs at most that fast."});
  }

  // Worlds in which runs failed come first.
  [[nodiscard]] std::vector<std::string> worlds_to_show() const {
    std::vector<std::string> worlds = result_.worlds;
    const auto failed = [&](const std::string& world) {
      return std::ranges::any_of(result_.variants, [&](const VariantResult& variant) {
        const auto found = result_.matrix.find({variant.name, world});
        return found != result_.matrix.end() && found->second.first < found->second.second;
      });
    };
    std::ranges::stable_partition(worlds, failed);
    worlds.resize(std::min(worlds.size(), kShownWorlds));
    return worlds;
  }

  void tracks() {
    bool is_first = true;
    for (const std::string& world : worlds_to_show()) {
      Map map;
      for (const Row& row : rows_)
        if (row.world == world) add(map, row);
      map.contacts.clear();  // of many runs they say nothing: each failure has its own map
      if (map.tracks.empty()) continue;
      if (is_first) document_.add(Heading{"Where they drove"});
      is_first = false;
      document_.add(
          Figure{{legend_plot(variant_names()), map_plot(map)},
                 "World " + world + ": all seeds; a circle marks the end of a run without success."});
    }
  }

  // The walls are those of the first run: what moves is elsewhere in each.
  void add(Map& map, const Row& row) const {
    const Sketch sketch = store_.sketch(row.variant, row.world, row.seed);
    if (map.walls.empty()) map.walls = read_lines(sketch.walls);
    for (Places& places : read_lines(sketch.tracks))
      map.tracks.push_back(
          {std::move(places), number_of(row.variant), row.outcome.ending != Ending::success});
    for (const Places& contact : read_lines(sketch.contacts)) map.contacts.push_back(contact.front());
  }

  void failures() {
    std::map<std::pair<std::string, std::string>, std::size_t> shown;
    bool is_first = true;
    for (const Row& row : rows_) {
      if (row.outcome.ending == Ending::success) continue;
      const std::string kind = kind_of(row.outcome);
      if (shown[{row.variant, kind}]++ >= kShownFailures) continue;
      if (is_first) {
        document_.add(Heading{"Runs without success"});
        document_.add(Paragraph{"Each command makes its run again, in the folder of the experiment."});
      }
      is_first = false;
      document_.add(Paragraph{row.variant + " in " + row.world + ", seed " + std::to_string(row.seed) + ": " +
                              kind + (row.outcome.reason.empty() ? "" : " (" + row.outcome.reason + ")")});
      Map map;
      add(map, row);
      if (!map.tracks.empty())
        document_.add(
            Figure{{map_plot(map)},
                   map.contacts.empty()
                       ? "Where it drove, up to the circle."
                       : "Where it drove, up to the circle; a cross marks each of the first contacts."});
      if (const auto run = find(row)) document_.add(Command{replay_command(experiment_, *run)});
    }
    for (const auto& [what, count] : shown)
      if (count > kShownFailures)
        document_.add(Paragraph{"And " + std::to_string(count - kShownFailures) + " more of " + what.first +
                                ": " + what.second});
  }

  static std::string kind_of(const Outcome& outcome) {
    const std::string failure = name_of(outcome.failure);
    const std::string ending = name_of(outcome.ending);
    return failure.empty() || failure == ending ? ending : ending + ", " + failure;
  }

  [[nodiscard]] std::optional<Run> find(const Row& row) const {
    const auto variant = std::ranges::find(experiment_.variants, row.variant, &Variant::name);
    const auto world = std::ranges::find(experiment_.worlds, row.world, &World::name);
    if (variant == experiment_.variants.end() || world == experiment_.worlds.end()) return std::nullopt;
    return Run{static_cast<std::size_t>(variant - experiment_.variants.begin()),
               static_cast<std::size_t>(world - experiment_.worlds.begin()), row.seed};
  }

  const Experiment& experiment_;
  const Store& store_;
  const std::vector<Row>& rows_;
  const BatchResult& result_;
  Document document_;
};

// Returns "NAME=VALUE" as a word for a shell in the experiment's folder. A path must stay absolute: a graph would read it from its own folder on.
std::string setting_word(const Experiment& experiment, const std::string& setting) {
  const std::size_t value = setting.find('=') + 1;
  const std::string relative = from_folder_of(experiment, setting.substr(value));
  if (relative == setting.substr(value)) return in_shell_quotes(setting);
  return in_shell_quotes(setting.substr(0, value)) + "\"$PWD\"/" + in_shell_quotes(relative);
}

// @param clock  options that choose the run's clock.
std::string command_of(const Experiment& experiment, const Run& run, const std::string& clock) {
  const Variant& variant = experiment.variants[run.variant];
  std::string text = "deployer " + in_shell_quotes(from_folder_of(experiment, variant.graph));
  for (const std::string& profile : variant.profiles) text += " --profile " + in_shell_quotes(profile);
  text += " " + clock + " --seed " + std::to_string(run.seed) + " --until " +
          in_shell_quotes(xml::number_text(to_seconds(experiment.until)) + " s");
  for (const std::string& setting : experiment.settings_of(run))
    text += " --set " + setting_word(experiment, setting);
  for (const Failing& one : experiment.worlds[run.world].failing) text += " --fail " + one.order(run.seed);
  return text;
}

}  // namespace

std::string replay_command(const Experiment& experiment, const Run& run) {
  const double computing = experiment.variants[run.variant].computing;
  return command_of(
      experiment, run,
      "--clock virtual" + (computing == 1.0 ? "" : " --computing " + xml::number_text(computing)));
}

std::string watch_command(const Experiment& experiment, const Run& run) {
  return command_of(experiment, run, "--view");
}

Result<Report> make_report(const Experiment& experiment, const Store& store) {
  std::vector<Row> rows;
  if (const Status read = store.for_each([&](const Row& row) { rows.push_back(row); }); !read.ok())
    return read.error();
  if (rows.empty()) return fail(Code::failed_precondition, "there are no results yet");
  Result<BatchResult> result = compare(rows, {questions_of(experiment), families_of(experiment)});
  if (!result) return result.error();
  put_in_order(experiment, result->worlds);
  const Document document = Writer(experiment, store, rows, *result).write();
  std::string summary;
  for (const Reversal& reversal : result->reversals) summary += line_of(reversal) + "\n";
  for (const VariantResult& variant : result->variants) summary += line_of(variant) + "\n";
  for (const std::string& line : lines_on_runs(experiment, rows, *result)) summary += line + "\n";
  for (const Difference& difference : result->differences)
    summary += line_of(difference) + families_text(difference, *result) + "\n";
  for (const Contrast& contrast : result->unanswered) summary += line_of(contrast) + "\n";
  return Report{to_html(document), to_markdown(document), to_files(document), std::move(summary)};
}

}  // namespace orca::batch
