// SPDX-License-Identifier: LGPL-3.0-or-later
#include "orca/batch/tuning.hpp"

#include <algorithm>
#include <cstdio>
#include <utility>

#include "orca/base/portable_math.hpp"
#include "orca/base/random.hpp"
#include "orca/base/text.hpp"
#include "orca/xml/document.hpp"
#include "orca/xml/number.hpp"

namespace orca::batch {
namespace {

constexpr double kPenalty = 10.0;
constexpr double kHour = 3600.0;  // [s]

std::string short_text(double value, const char* format = "%.4g") {
  char text[32];
  std::snprintf(text, sizeof text, format, value);
  return text;
}

// Four digits are enough for people, and what is written is what was run.
Setting drawn(const SettingRange& range, RandomStream& random) {
  const double value = range.by_factors
                           ? portable::exp(random.uniform(portable::log(range.from), portable::log(range.to)))
                           : random.uniform(range.from, range.to);
  std::string text = short_text(value);
  const Result<double> rounded = xml::parse_number(text);
  if (!rounded || *rounded < range.from || *rounded > range.to) text = xml::number_text(value);
  return {range.name, range.unit.empty() ? text : text + " " + range.unit, range.position};
}

std::vector<Setting> settings_of_draw(const Variant& variant, std::size_t number, std::uint64_t seed) {
  std::vector<Setting> settings;
  if (number == 0) return settings;
  for (const SettingRange& range : variant.ranges) {
    RandomStream random(seed, variant.name + "_" + std::to_string(number), range.name);
    settings.push_back(drawn(range, random));
  }
  return settings;
}

// Adds a setting, in the place of one of the same name.
void replace(std::vector<Setting>& settings, const Setting& by) {
  std::erase_if(settings, [&](const Setting& setting) { return setting.name == by.name; });
  settings.push_back(by);
}

Draw judge(const Experiment& experiment, const std::string& variant, const Store& store) {
  Draw draw;
  const double limit = to_seconds(experiment.until);
  for (const World& world : experiment.worlds)
    for (const std::uint64_t seed : experiment.seeds) {
      const std::optional<Row> row = store.find(variant, world.name, seed);
      if (!row) continue;
      const bool succeeds = row->outcome.ending == Ending::success;
      ++draw.runs;
      draw.successes += succeeds ? 1 : 0;
      draw.penalised_time += succeeds ? row->outcome.time : kPenalty * limit;
      draw.robot_time += row->outcome.time;
    }
  if (draw.runs > 0) draw.penalised_time /= static_cast<double>(draw.runs);
  return draw;
}

std::string list_of(const std::vector<Setting>& settings) {
  std::vector<std::string> texts;
  for (const Setting& setting : settings) texts.push_back(setting.text());
  return joined(texts, "; ");
}

}  // namespace

Result<Experiment> draws_of(const Experiment& experiment) {
  if (!experiment.tuning)
    return fail(
        Code::failed_precondition,
        in_quotes(experiment.file) + " has no <tuning>: it says how many draws to make, and in which worlds");
  Experiment all = experiment;
  all.name += "_tuning";
  all.variants.clear();
  all.contrasts.clear();
  all.worlds = experiment.tuning->worlds;
  all.tuning.reset();
  for (const Variant& variant : experiment.variants) {
    if (variant.ranges.empty()) continue;
    for (std::size_t number = 0; number < experiment.tuning->draws; ++number) {
      all.variants.push_back(variant);
      all.variants.back().name += "_" + std::to_string(number);
      for (const Setting& setting : settings_of_draw(variant, number, experiment.tuning->seed))
        replace(all.variants.back().settings, setting);
    }
  }
  if (all.variants.empty())
    return fail(Code::failed_precondition,
                "no variant of " + in_quotes(experiment.file) + " has a <tune>: there is nothing to choose");
  return all;
}

const Draw& Tuned::best() const { return *std::ranges::min_element(draws, {}, &Draw::penalised_time); }

std::string Tuned::text(const Tuning& tuning) const {
  std::size_t runs = 0;
  double robot_time = 0.0;
  for (const Draw& draw : draws) {
    runs += draw.runs;
    robot_time += draw.robot_time;
  }
  const auto result = [](const Draw& draw) {
    return std::to_string(draw.successes) + " of " + std::to_string(draw.runs) +
           " runs succeed, penalised time " + short_text(draw.penalised_time, "%.2f") + " s";
  };
  return "draw " + std::to_string(best().number) + " of " + std::to_string(draws.size()) + " (seed " +
         std::to_string(tuning.seed) + "): " + result(best()) + "; as declared: " + result(draws.front()) +
         "; " + std::to_string(runs) + " runs in " + std::to_string(tuning.worlds.size()) + " worlds, " +
         short_text(robot_time / kHour, "%.2f") + " robot hours";
}

std::vector<Tuned> judged(const Experiment& experiment, const Experiment& drawn, const Store& store) {
  std::vector<Tuned> all;
  for (const Variant& variant : experiment.variants) {
    if (variant.ranges.empty()) continue;
    Tuned tuned{variant.name, {}};
    for (std::size_t number = 0; number < experiment.tuning->draws; ++number) {
      tuned.draws.push_back(judge(drawn, variant.name + "_" + std::to_string(number), store));
      tuned.draws.back().number = number;
      tuned.draws.back().settings = settings_of_draw(variant, number, experiment.tuning->seed);
    }
    all.push_back(std::move(tuned));
  }
  return all;
}

std::string settings_file(const Tuned& tuned, const Experiment& experiment) {
  std::string text =
      "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<!-- Made by simbatch tune for the variant " +
      tuned.variant + " of " + experiment.name + ".\n     " + tuned.text(*experiment.tuning) +
      " -->\n<settings version=\"1\">\n";
  for (const Setting& setting : tuned.best().settings)
    text +=
        "  <set arg=\"" + xml::escaped(setting.name) + "\" value=\"" + xml::escaped(setting.value) + "\"/>\n";
  return text + "</settings>\n";
}

std::string draws_table(const std::vector<Tuned>& all) {
  std::string text = "variant,draw,runs,successes,penalised_time,robot_time,settings\n";
  for (const Tuned& tuned : all)
    for (const Draw& draw : tuned.draws)
      text += tuned.variant + "," + std::to_string(draw.number) + "," + std::to_string(draw.runs) + "," +
              std::to_string(draw.successes) + "," + xml::number_text(draw.penalised_time) + "," +
              xml::number_text(draw.robot_time) + ",\"" + list_of(draw.settings) + "\"\n";
  return text;
}

}  // namespace orca::batch
