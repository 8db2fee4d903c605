// SPDX-License-Identifier: LGPL-3.0-or-later
#include "tuned_ranges.hpp"

#include <algorithm>
#include <filesystem>
#include <set>
#include <string>

#include "orca/base/text.hpp"
#include "orca/xml/quantity.hpp"
#include "rules.hpp"

namespace orca::batch {
namespace {

// The texts by which a world is found again: its files, or else all that is set in it.
std::set<std::string> marks_of(const World& world) {
  std::set<std::string> files;
  std::string all;
  for (const Setting& setting : world.settings) {
    all += setting.text() + "\n";
    if (std::filesystem::path(setting.value).is_absolute()) files.insert(setting.text());
  }
  return files.empty() ? std::set{all} : files;
}

}  // namespace

std::optional<SettingRange> read_range(const xml::Attributes& element) {
  const auto name = element.text("arg");
  const auto from = element.text("from");
  const auto to = element.text("to");
  const std::string scale = element.choice("scale").value_or("linear");
  if (!name || !from || !to) return std::nullopt;
  const Result<xml::Measured> low = xml::parse_measured(*from);
  const Result<xml::Measured> high = xml::parse_measured(*to);
  if (!low) return element.refuse_at("from", codes::kTuning, low.error().message);
  if (!high) return element.refuse_at("to", codes::kTuning, high.error().message);
  if (low->si != high->si || low->value >= high->value)
    return element.refuse_at("to", codes::kTuning, "it must be above from, and of the same unit");
  if (scale == "log" && low->value <= 0.0)
    return element.refuse_at("from", codes::kTuning, "with scale=\"log\" it must be above 0");
  return SettingRange{*name, low->value, high->value, low->si, scale == "log", element.element().position()};
}

void check_held_out(const Experiment& experiment, xml::Reporter& reporter) {
  if (!experiment.tuning) return;
  for (const World& seen : experiment.tuning->worlds) {
    const std::set<std::string> marks = marks_of(seen);
    const auto same = std::ranges::find_if(experiment.worlds, [&](const World& world) {
      return std::ranges::any_of(marks_of(world),
                                 [&](const std::string& mark) { return marks.contains(mark); });
    });
    if (same == experiment.worlds.end()) continue;
    reporter.error(codes::kTuning, seen.position,
                   "world " + in_quotes(seen.name) + " of the tuner is " + in_quotes(same->name) +
                       " of the experiment; tune in worlds in which nothing is compared");
  }
}

}  // namespace orca::batch
