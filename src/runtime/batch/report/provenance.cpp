// SPDX-License-Identifier: LGPL-3.0-or-later
#include "provenance.hpp"

#include <algorithm>
#include <filesystem>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "declared.hpp"
#include "orca/base/json.hpp"
#include "orca/base/text.hpp"
#include "orca/batch/report.hpp"
#include "orca/xml/document.hpp"
#include "orca/xml/number.hpp"

namespace orca::batch {
namespace {

constexpr const char* kRealism = "realism";
constexpr const char* kAsInGraph = "as in the graph";

// One thing in which variants differ: a value for each of them, in their order.
struct Parameter {
  std::string name;
  std::vector<std::string> values;
};

// Returns what a variant sets, by name; the last word counts.
std::map<std::string, std::string> settings_of(const Experiment& experiment, const Variant& variant) {
  std::map<std::string, std::string> values{{"graph", from_folder_of(experiment, variant.graph)},
                                            {"profile", joined(variant.profiles, " ")},
                                            {"computing", xml::number_text(variant.computing)}};
  for (const Setting& setting : variant.settings)
    values[setting.name] = from_folder_of(experiment, setting.value);
  return values;
}

std::vector<Parameter> differing_parameters(const Experiment& experiment) {
  std::vector<std::map<std::string, std::string>> all;
  std::set<std::string> names;
  for (const Variant& variant : experiment.variants) {
    all.push_back(settings_of(experiment, variant));
    for (const auto& [name, value] : all.back()) names.insert(name);
  }
  std::vector<Parameter> differing;
  for (const std::string& name : names) {
    Parameter one{name, {}};
    for (const auto& values : all) {
      const auto found = values.find(name);
      one.values.push_back(found == values.end() || found->second.empty() ? kAsInGraph : found->second);
    }
    if (std::ranges::adjacent_find(one.values, std::ranges::not_equal_to{}) != one.values.end())
      differing.push_back(std::move(one));
  }
  return differing;
}

void add_levels(const std::vector<Setting>& settings, std::set<std::string>& levels) {
  for (const Setting& setting : settings)
    if (setting.name == kRealism || setting.name.ends_with(std::string(".") + kRealism))
      levels.insert(setting.value);
}

// Returns the levels of realism that the experiment sets anywhere.
std::vector<std::string> realism_of(const Experiment& experiment) {
  std::set<std::string> levels;
  add_levels(experiment.settings, levels);
  for (const World& world : experiment.worlds) add_levels(world.settings, levels);
  for (const Variant& variant : experiment.variants) add_levels(variant.settings, levels);
  return {levels.begin(), levels.end()};
}

// Returns the builds that made runs, the earliest first.
std::vector<Declaration> builds_of(const Store& store) {
  std::vector<Declaration> builds = store.declarations();
  std::erase_if(builds, [](const Declaration& one) { return one.what != kBuildDeclaration; });
  return builds;
}

std::string file_name(const Experiment& experiment) {
  return std::filesystem::path(experiment.file).filename().string();
}

std::vector<std::string> texts_of(const Experiment& experiment, const std::vector<Setting>& settings) {
  std::vector<std::string> texts;
  for (const Setting& setting : settings)
    texts.push_back(setting.name + "=" + from_folder_of(experiment, setting.value));
  return texts;
}

void write_parameters(const Experiment& experiment, JsonWriter& json) {
  json.key("differing_parameters").begin_object();
  for (const Parameter& one : differing_parameters(experiment)) {
    json.key(one.name).begin_object();
    for (std::size_t i = 0; i < one.values.size(); ++i)
      json.member(experiment.variants[i].name, one.values[i]);
    json.end();
  }
  json.end();
}

void write_worlds(const Experiment& experiment, JsonWriter& json) {
  json.key("worlds").begin_array();
  for (const World& world : experiment.worlds) {
    json.begin_object();
    json.member("name", world.name);
    json.member("family", world.family);
    json.member("settings", texts_of(experiment, world.settings));
    if (!world.failing.empty()) {
      json.key("failing").begin_array();
      for (const Failing& one : world.failing) json.value(one.text());
      json.end();
    }
    json.end();
  }
  json.end();
}

void write_builds(const Store& store, JsonWriter& json) {
  json.key("made").begin_array();
  for (const Declaration& build : builds_of(store)) {
    json.begin_object();
    json.member("since", build.date);
    json.member("by", build.text);
    json.end();
  }
  json.end();
}

}  // namespace

std::string from_folder_of(const Experiment& experiment, const std::string& value) {
  const std::filesystem::path path(value);
  if (!path.is_absolute()) return value;
  return path.lexically_relative(std::filesystem::absolute(experiment.file).lexically_normal().parent_path())
      .string();
}

void add_provenance(const Experiment& experiment, const Store& store, Document& document) {
  document.add(Heading{"Where the results come from"});
  Table facts{{"what", "value"}, {}};
  for (const Declaration& build : builds_of(store))
    facts.rows.push_back({"made since " + build.date + " by", build.text});
  facts.rows.push_back({"experiment", file_name(experiment)});
  facts.rows.push_back({"seeds", ranges_text(experiment.seeds)});
  const std::vector<std::string> realism = realism_of(experiment);
  facts.rows.push_back({"realism", realism.empty() ? "as the graphs say" : joined(realism, ", ")});
  document.add(std::move(facts));
  Table parameters{{"parameter"}, {}};
  for (const Variant& variant : experiment.variants) parameters.head.push_back(variant.name);
  for (const Parameter& one : differing_parameters(experiment)) {
    parameters.rows.push_back({one.name});
    parameters.rows.back().insert(parameters.rows.back().end(), one.values.begin(), one.values.end());
  }
  document.add(
      Paragraph{parameters.rows.empty()
                    ? "The experiment sets the same for all variants."
                    : "The experiment sets these differently; graphs that are not the same differ in more:"});
  if (!parameters.rows.empty()) document.add(std::move(parameters));
  Table inputs{{"program, plugin or file", "hash (64-bit FNV-1a)"}, {}};
  for (const auto& [name, hash] : store.inputs())
    if (!name.starts_with("world ")) inputs.rows.push_back({name, hash});
  if (!inputs.rows.empty()) document.add(std::move(inputs));
  if (const Result<std::string> text = xml::read_bytes(experiment.file)) document.add(Command{*text});
}

std::string provenance_json(const Experiment& experiment, const Store& store) {
  JsonWriter json;
  json.begin_object();
  json.member("experiment", experiment.name);
  json.member("file", file_name(experiment));
  write_builds(store, json);
  json.member("seeds", ranges_text(experiment.seeds));
  json.member("until", to_seconds(experiment.until));
  json.member(kRealism, realism_of(experiment));
  json.member("settings", texts_of(experiment, experiment.settings));
  write_parameters(experiment, json);
  write_worlds(experiment, json);
  json.key("hashes").begin_object();
  for (const auto& [name, hash] : store.inputs()) json.member(name, hash);
  json.end();
  const Result<std::string> text = xml::read_bytes(experiment.file);
  json.member("text", text ? *text : "");
  json.end();
  return json.text();
}

}  // namespace orca::batch
