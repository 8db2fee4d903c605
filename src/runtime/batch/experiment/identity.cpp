// SPDX-License-Identifier: LGPL-3.0-or-later
#include <filesystem>
#include <string>
#include <vector>

#include "orca/base/hash.hpp"
#include "orca/batch/experiment.hpp"
#include "orca/xml/document.hpp"

namespace orca::batch {
namespace {

void add_settings(const std::vector<Setting>& settings, const std::string& folder, Fnv1a& hash) {
  for (const Setting& setting : settings) hash.add_text(setting.text_from(folder));
  hash.add_text("");
}

void add_goals(const std::vector<Goal>& goals, Fnv1a& hash) {
  for (const Goal& goal : goals) hash.add_text(goal_text(goal));
  hash.add_text("");
}

}  // namespace

std::string Setting::text_from(const std::string& folder) const {
  const std::filesystem::path path(value);
  return name + "=" + (path.is_absolute() ? path.lexically_relative(folder).string() : value);
}

std::string identity_of(const Experiment& experiment) {
  Fnv1a hash;
  hash.add_text(experiment.name);
  hash.add_u64(static_cast<std::uint64_t>(experiment.until.count()));
  if (experiment.has_task) hash.add_text("task");
  const std::string folder = std::filesystem::absolute(experiment.file).lexically_normal().parent_path();
  add_settings(experiment.settings, folder, hash);
  add_goals(experiment.goals, hash);
  for (const Variant& variant : experiment.variants) {
    hash.add_text(variant.name);
    const Result<std::string> graph = xml::read_bytes(variant.graph);
    hash.add_text(graph ? *graph : variant.graph);
    for (const std::string& profile : variant.profiles) hash.add_text(profile);
    hash.add_text("");
    add_settings(variant.settings, folder, hash);
  }
  return std::to_string(hash.value());
}

}  // namespace orca::batch
