// SPDX-License-Identifier: LGPL-3.0-or-later
#include <algorithm>
#include <filesystem>
#include <map>
#include <numbers>
#include <sstream>
#include <utility>

#include "number_list.hpp"
#include "orca/base/text.hpp"
#include "orca/batch/experiment.hpp"
#include "orca/xml/attributes.hpp"
#include "orca/xml/document.hpp"
#include "orca/xml/names.hpp"
#include "orca/xml/number.hpp"
#include "orca/xml/quantity.hpp"
#include "orca/xml/reporter.hpp"
#include "orca/xml/values.hpp"
#include "references.hpp"
#include "results/metric.hpp"
#include "rules.hpp"
#include "tuned_ranges.hpp"

namespace orca::batch {
namespace {

using xml::Attributes;

constexpr std::size_t kMostRuns = 10'000'000;
constexpr double kDefaultLimit = 300.0;                       // [s]
constexpr double kDefaultMemory = 8.0e9;                      // [bytes]
constexpr double kDefaultTolerance = std::numbers::pi / 9.0;  // [rad]

std::vector<std::string> words_of(const std::string& text) {
  const std::vector<std::string_view> words = xml::words(text);
  return {words.begin(), words.end()};
}

class ExperimentReader {
 public:
  ExperimentReader(const std::string& file, xml::Reporter& reporter)
      : folder_(std::filesystem::absolute(file).parent_path()), reporter_(reporter) {
    experiment_.file = file;
  }

  Experiment read(const xml::Element& root) {
    const Attributes attributes(root, kExperimentRule, kExperimentFile, reporter_);
    header(attributes);
    for (const auto& [element, rule] : attributes.children()) {
      const Attributes child = attributes.of_child(*element, *rule);
      if (rule == &kSetRule) set(child, experiment_.settings);
      if (rule == &kGoalRule) goal(child, experiment_.goals);
      if (rule == &kVariantRule) variant(child);
      if (rule == &kWorldRule) world(child);
      if (rule == &kWorldsRule) worlds(child);
      if (rule == &kContrastRule) contrasts_.push_back(child);
      if (rule == &kTuningRule) tuning(child);
    }
    multiply(factors(attributes));
    for (const Attributes& element : contrasts_) contrast(element);
    check_whole(attributes);
    check_held_out(experiment_, reporter_);
    return std::move(experiment_);
  }

 private:
  void header(const Attributes& experiment) {
    experiment_.name = experiment.name("name").value_or("");
    const auto version = experiment.text("version");
    if (version && *version != "1")
      experiment.error_at("version", codes::kBadValue,
                          "version " + in_quotes(*version) + " is not known; the only one is \"1\"");
    if (experiment.has("graph")) graph_ = path(experiment.text("graph").value_or(""));
    profiles_ = words_of(experiment.text("profile").value_or(""));
    experiment_.seeds = numbers(experiment, "seeds");
    experiment_.metrics = metrics(experiment);
    if (experiment.has("claims")) experiment_.has_task = experiment.choice("claims") == "task";
    experiment_.until = experiment.duration("until").value_or(Duration{0});
    experiment_.limit = experiment.duration_or("limit", from_seconds(kDefaultLimit)).value_or(Duration{0});
    experiment_.memory_limit =
        static_cast<std::uint64_t>(experiment.number_or("memory", kDefaultMemory).value_or(0.0));
  }

  void variant(const Attributes& element) {
    Variant variant{element.name("name").value_or(""), graph_, {}, element.element().position(), profiles_};
    if (element.has("profile")) variant.profiles = words_of(element.text("profile").value_or(""));
    if (element.has("graph")) variant.graph = path(element.text("graph").value_or(""));
    if (variant.graph.empty())
      element.error(codes::kNoGraph, "variant " + in_quotes(variant.name) +
                                         " has no graph; give it one, or the experiment one for all");
    for (const auto& [child, rule] : element.children()) {
      const Attributes part = element.of_child(*child, *rule);
      if (rule == &kSetRule) set(part, variant.settings);
      if (rule != &kTuneRule) continue;
      if (auto range = read_range(part)) variant.ranges.push_back(*std::move(range));
    }
    if (element.has("settings")) add_settings_of_file(element, variant.settings);
    remember(element, "variant", variant.name);
    experiment_.variants.push_back(std::move(variant));
  }

  void world(const Attributes& element) {
    World world{element.name("name").value_or(""), {}, element.element().position()};
    if (element.has("reference")) world.reference = element.number("reference");
    world.family = element.has("family") ? element.name("family").value_or("") : world.name;
    parts(element, world);
    remember(element, "world", world.name);
    experiment_.worlds.push_back(std::move(world));
  }

  void worlds(const Attributes& element) {
    const std::string name = element.name("name").value_or("");
    const std::string arg = element.text("arg").value_or("");
    const std::string file = path(element.text("file").value_or(""));
    const xml::Position& position = element.element().position();
    World all;
    all.position = position;
    parts(element, all);
    const std::map<std::uint64_t, double> lengths = references(element);
    for (const std::uint64_t number : numbers_of_worlds(element, lengths)) {
      World world = all;
      world.name = name + "_" + std::to_string(number);
      for (Failing& one : world.failing) one.world = world.name;
      world.settings.push_back({arg, file + "#" + std::to_string(number), position});
      if (!remember(element, "world", world.name)) return;
      world.family = name;
      if (const auto length = lengths.find(number); length != lengths.end()) world.reference = length->second;
      experiment_.worlds.push_back(std::move(world));
    }
  }

  // Returns the numbers that are named, or else those of the table.
  std::vector<std::uint64_t> numbers_of_worlds(const Attributes& element,
                                               const std::map<std::uint64_t, double>& table) {
    if (element.has("numbers")) return numbers(element, "numbers");
    if (!element.has("references"))
      element.error(codes::kMissing, "<worlds> needs numbers, or a table of references that has them");
    std::vector<std::uint64_t> all;
    for (const auto& [number, length] : table) all.push_back(number);
    return all;
  }

  std::map<std::uint64_t, double> references(const Attributes& element) {
    if (!element.has("references")) {
      if (element.has("column"))
        element.error_at("column", codes::kReferences, "a column needs the table, references");
      return {};
    }
    const std::string table = path(element.text("references").value_or(""));
    auto read = read_references(table, element.text("column").value_or("reference"));
    experiment_.tables.push_back(table);
    if (read) return std::move(read).value();
    element.error_at("references", codes::kReferences, read.error().message);
    return {};
  }

  // Reads what stands in a world.
  void parts(const Attributes& element, World& world) {
    for (const auto& [child, rule] : element.children()) {
      const Attributes part = element.of_child(*child, *rule);
      if (rule == &kSetRule) set(part, world.settings);
      if (rule == &kGoalRule) goal(part, world.goals);
      if (rule == &kFailRule) failing(part, world.failing);
    }
  }

  static void failing(const Attributes& element, std::vector<Failing>& to) {
    Failing one{.component = element.name("component").value_or(""),
                .how = element.choice("how").value_or(""),
                .at = element.duration_or("at", Duration{0}).value_or(Duration{0}),
                .position = element.element().position()};
    if (element.has("latest")) one.latest = element.duration_or("latest", Duration{0}).value_or(Duration{0});
    if (one.latest && *one.latest <= one.at)
      element.error_at("latest", codes::kFail, "it must be after the time in at");
    if (std::ranges::find(to, one.component, &Failing::component) != to.end())
      element.error_at("component", codes::kFail, in_quotes(one.component) + " fails already");
    to.push_back(std::move(one));
  }

  void goal(const Attributes& element, std::vector<Goal>& to) {
    const bool has_position = element.has("x") && element.has("y");
    if (element.has("place") ? element.has("x") || element.has("y") : !has_position)
      element.error(codes::kGoalPlace, "<goal> needs either the name of a place, or x and y");
    if (element.has("heading_tolerance") && !element.has("heading"))
      element.error_at("heading_tolerance", codes::kGoalPlace,
                       "a tolerance needs the heading that it is for");
    Goal goal{.robot = element.text("robot").value_or(""), .place = element.text("place").value_or("")};
    if (has_position) goal.position = {element.number("x").value_or(0.0), element.number("y").value_or(0.0)};
    goal.declared_at = element.element().position();
    goal.radius = element.number("radius").value_or(0.0);
    if (element.has("heading")) {
      goal.heading = element.number("heading");
      goal.heading_tolerance = element.number_or("heading_tolerance", kDefaultTolerance).value_or(0.0);
    }
    goal.hold = element.duration_or("hold", Duration{0}).value_or(Duration{0});
    to.push_back(std::move(goal));
  }

  void contrast(const Attributes& element) {
    Contrast contrast{variant_in(element, "first"), variant_in(element, "second"), "", {}, "", {}};
    contrast.position = element.element().position();
    if (contrast.first == contrast.second && !contrast.first.empty())
      element.error_at("second", codes::kContrast, "a contrast needs two variants");
    contrast.metric = element.text("metric").value_or("");
    const Metric* const metric =
        contrast.metric.empty() ? nullptr : metric_in(element, "metric", contrast.metric);
    const std::string claim = element.choice("claim").value_or("difference");
    if (claim != "difference") contrast.asked.claim = claim == "equal" ? Claim::equal : Claim::not_worse;
    if ((claim == "difference") == element.has("margin"))
      element.error(codes::kContrast, "claims of not_worse and equal need a margin, and no other has one");
    if (metric != nullptr) {
      contrast.asked.more_is_better = metric->more_is_better;
      margin(element, *metric, contrast);
    }
    experiment_.contrasts.push_back(std::move(contrast));
  }

  static void margin(const Attributes& element, const Metric& metric, Contrast& contrast) {
    if (!element.has("margin")) return;
    contrast.margin = element.text("margin").value_or("");
    const Result<double> read = xml::parse_quantity(contrast.margin, metric.unit);
    if (!read)
      element.error_at("margin", codes::kContrast, read.error().message);
    else if (!(*read > 0.0))
      element.error_at("margin", codes::kContrast, "a margin is above 0");
    else if (metric.is_success() && *read >= 1.0)
      element.error_at(
          "margin", codes::kContrast,
          "a margin of success is below 100 %: no two shares differ by more, so the claim would hold "
          "whatever the runs are");
    else
      contrast.asked.margin = *read;
  }

  // Returns the name of a variant that there is.
  [[nodiscard]] std::string variant_in(const Attributes& element, const char* attribute) const {
    const std::string name = element.text(attribute).value_or("");
    std::vector<std::string> known;
    for (const Variant& variant : experiment_.variants) known.push_back(variant.name);
    if (!name.empty() && std::ranges::find(known, name) == known.end())
      element.error_at(attribute, codes::kContrast,
                       "there is no variant " + in_quotes(name) + "; there are " + listed(known) +
                           xml::did_you_mean(xml::nearest_name(name, known)));
    return name;
  }

  // Adds the settings that a file holds, but for those that the variant has itself. Their paths start at the experiment's folder, too.
  void add_settings_of_file(const Attributes& variant, std::vector<Setting>& to) {
    const std::string file = path(variant.text("settings").value_or(""));
    const std::optional<xml::Document> document = xml::read_file(file, reporter_.diagnostics());
    experiment_.tables.push_back(file);
    if (!document) return;
    const xml::Element& root = document->root;
    if (root.name() != kSettingsFileRule.name)
      return variant.error_at("settings", codes::kWrongRoot,
                              in_quotes(file) + " holds <" + root.name() + ">, not <settings>");
    const Attributes attributes(root, kSettingsFileRule, kExperimentFile, reporter_);
    std::vector<Setting> settings;
    for (const auto& [child, rule] : attributes.children()) set(attributes.of_child(*child, *rule), settings);
    const std::vector<Setting> own = to;
    for (Setting& setting : settings)
      if (std::ranges::find(own, setting.name, &Setting::name) == own.end()) to.push_back(std::move(setting));
  }

  // The worlds of a tuner are read as those of the experiment.
  void tuning(const Attributes& element) {
    std::vector<World> own = std::exchange(experiment_.worlds, {});
    for (const auto& [child, rule] : element.children()) {
      const Attributes part = element.of_child(*child, *rule);
      if (rule == &kWorldRule) world(part);
      if (rule == &kWorldsRule) worlds(part);
    }
    experiment_.tuning =
        Tuning{static_cast<std::size_t>(element.integer("draws").value_or(2)),
               static_cast<std::uint64_t>(element.has("seed") ? element.integer("seed").value_or(1) : 1),
               std::exchange(experiment_.worlds, std::move(own))};
    if (experiment_.tuning->worlds.empty())
      element.error(codes::kMissing, "a tuner needs a <world> or <worlds> of its own");
  }

  void set(const Attributes& element, std::vector<Setting>& to) {
    const auto arg = element.text("arg");
    if (element.has("value") == element.has("file")) {
      element.error(codes::kValueOrFile, "<set> needs either a value or a file");
      return;
    }
    const auto value = element.text(element.has("value") ? "value" : "file");
    if (!arg || !value) return;
    to.push_back({*arg, element.has("file") ? path(*value) : *value, element.element().position()});
  }

  std::vector<std::string> metrics(const Attributes& experiment) const {
    std::istringstream words(experiment.text("metrics").value_or("success time"));
    std::vector<std::string> names;
    for (std::string name; words >> name;) {
      (void)metric_in(experiment, "metrics", name);
      names.push_back(std::move(name));
    }
    return names;
  }

  // Returns the factors of the time that laps take; none: it is not asked what that changes.
  std::vector<double> factors(const Attributes& experiment) const {
    constexpr xml::ValueRule kFactor{.form = xml::ValueRule::Form::number, .min = 0.0, .max = 1e6};
    std::istringstream words(experiment.text("computing").value_or(""));
    std::vector<double> read;
    for (std::string word; words >> word;) {
      xml::ValueFault fault;
      if (const auto factor = xml::read_number(word, kFactor, fault)) {
        if (std::ranges::find(read, *factor) == read.end()) read.push_back(*factor);
      } else {
        experiment.error_at("computing", codes::kBadValue, fault.message);
      }
    }
    return read;
  }

  // Makes of each variant one for each factor.
  void multiply(const std::vector<double>& factors) {
    if (factors.empty()) return;
    std::vector<Variant> all;
    for (const Variant& variant : experiment_.variants)
      for (const double factor : factors) {
        all.push_back(variant);
        all.back().name += "_x" + xml::number_text(factor);
        all.back().computing = factor;
      }
    experiment_.variants = std::move(all);
  }

  // Returns the metric of that name; reports that there is none.
  static const Metric* metric_in(const Attributes& element, const char* attribute, const std::string& name) {
    const Metric* const metric = find_metric(name);
    if (metric != nullptr) return metric;
    std::vector<std::string> known;
    for (const Metric& one : all_metrics()) known.push_back(one.name);
    element.error_at(attribute, codes::kBadValue,
                     "there is no metric " + in_quotes(name) + "; there are " + listed(known) +
                         xml::did_you_mean(xml::nearest_name(name, known)));
    return nullptr;
  }

  std::vector<std::uint64_t> numbers(const Attributes& element, const char* attribute) {
    const auto text = element.text(attribute);
    if (!text) return {};
    Result<std::vector<std::uint64_t>> read = read_number_list(*text);
    if (read) return std::move(read).value();
    element.error_at(attribute, codes::kNumbers, read.error().message);
    return {};
  }

  // Reports a name that another of its kind has already; returns whether it is new.
  bool remember(const Attributes& element, const std::string& kind, const std::string& name) {
    if (name.empty()) return true;  // reported
    const auto [known, is_new] = names_.try_emplace({kind, name}, element.element().position());
    if (!is_new)
      element.error_at("name", codes::kDuplicateName,
                       "there is a " + kind + " " + in_quotes(name) + " already, at " + known->second.text());
    return is_new;
  }

  void check_whole(const Attributes& experiment) {
    if (experiment_.variants.empty())
      experiment.error(codes::kMissing, "an experiment needs a <variant>, better two that are compared");
    if (experiment_.worlds.empty())
      experiment.error(codes::kMissing,
                       "an experiment needs a <world>; <world name=\"here\"/> leaves that of the graph");
    const double runs = static_cast<double>(experiment_.variants.size()) *
                        static_cast<double>(experiment_.worlds.size()) *
                        static_cast<double>(experiment_.seeds.size());
    if (runs > static_cast<double>(kMostRuns))
      experiment.error(codes::kTooMany, "the experiment has more than 10,000,000 runs");
  }

  // Paths start at the experiment's folder.
  [[nodiscard]] std::string path(const std::string& written) const {
    return written.empty() ? "" : (folder_ / written).lexically_normal().string();
  }

  const std::filesystem::path folder_;
  xml::Reporter& reporter_;
  Experiment experiment_;
  std::string graph_;                  // of variants that name none
  std::vector<std::string> profiles_;  // likewise
  std::vector<Attributes> contrasts_;  // read when all variants are known
  std::map<std::pair<std::string, std::string>, xml::Position> names_;
};

std::optional<Experiment> parts_of(const std::optional<xml::Document>& document, const std::string& file,
                                   xml::Diagnostics& diagnostics) {
  if (!document) return std::nullopt;
  xml::Reporter reporter(diagnostics);
  const xml::Element& root = document->root;
  if (root.name() != kExperimentRule.name) {
    reporter.error(codes::kWrongRoot, root.position(),
                   "this is <" + root.name() + ">, not <experiment>; a graph is run with deployer");
    return std::nullopt;
  }
  return ExperimentReader(file, reporter).read(root);
}

std::optional<Experiment> read(const std::optional<xml::Document>& document, const std::string& file,
                               xml::Diagnostics& diagnostics) {
  std::optional<Experiment> experiment = parts_of(document, file, diagnostics);
  return diagnostics.has_errors() ? std::nullopt : std::move(experiment);
}

}  // namespace

std::optional<Experiment> read_experiment(const std::string& file, xml::Diagnostics& diagnostics) {
  return read(xml::read_file(file, diagnostics), file, diagnostics);
}

std::optional<Experiment> read_parts(const std::string& file, xml::Diagnostics& diagnostics) {
  std::optional<Experiment> experiment = parts_of(xml::read_file(file, diagnostics), file, diagnostics);
  if (!experiment) return std::nullopt;
  std::erase_if(experiment->variants, [](const Variant& variant) { return variant.graph.empty(); });
  if (experiment->worlds.empty()) experiment->worlds.push_back({"that of the graph", {}, {}});
  if (experiment->seeds.empty()) experiment->seeds.push_back(1);
  return experiment;
}

std::optional<Experiment> read_experiment(std::string_view text, const std::string& file,
                                          xml::Diagnostics& diagnostics) {
  return read(xml::read_text(text, file, diagnostics), file, diagnostics);
}

}  // namespace orca::batch
