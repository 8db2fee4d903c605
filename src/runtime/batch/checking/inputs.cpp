// SPDX-License-Identifier: LGPL-3.0-or-later
#include "orca/batch/inputs.hpp"

#include <link.h>

#include <array>
#include <cstddef>
#include <filesystem>
#include <fstream>
#include <optional>
#include <set>
#include <span>

#include "orca/base/hash.hpp"
#include "orca/base/input_file.hpp"
#include "orca/xml/number.hpp"

namespace orca::batch {
namespace {

namespace fs = std::filesystem;

constexpr const char* kOwnLibrary = "liborca_";
constexpr const char* kTypeList =
    ".types";  // what lies beside a plugin says nothing that the plugin does not

bool is_plugin(const fs::path& file) { return file.extension() == ".so"; }

// Returns the experiment's own path without links.
fs::path own_path(const Experiment& experiment) {
  std::error_code unused;
  return fs::weakly_canonical(fs::absolute(experiment.file), unused);
}

std::string hash_of(const World& world, const fs::path& folder) {
  Fnv1a hash;
  for (const Setting& setting : world.settings) hash.add_text(setting.text_from(folder.string()));
  for (const Goal& goal : world.goals) hash.add_text(goal_text(goal));
  for (const Failing& one : world.failing) hash.add_text(one.text());
  if (world.reference) hash.add_text(xml::number_text(*world.reference));
  return std::to_string(hash.value());
}

int add_own_library(dl_phdr_info* info, std::size_t /*size*/, void* inputs) {
  const fs::path path = info->dlpi_name;
  if (!path.filename().string().starts_with(kOwnLibrary)) return 0;
  if (const auto content = content_hash(path))
    (*static_cast<Inputs*>(inputs))["library " + path.filename().string()] = *content;
  return 0;
}

}  // namespace

std::optional<std::string> content_hash(const std::string& path) {
  std::error_code unused;
  std::ifstream file(path, std::ios::binary);
  if (!fs::is_regular_file(path, unused) || !file) return std::nullopt;
  Fnv1a hash;
  std::array<char, 65536> bytes{};
  while (file.read(bytes.data(), bytes.size()), file.gcount() > 0)
    hash.add(std::as_bytes(std::span(bytes.data(), static_cast<std::size_t>(file.gcount()))));
  return std::to_string(hash.value());
}

std::vector<std::string> files_of(const Experiment& experiment) {
  std::error_code unused;
  std::set<std::string> files{own_path(experiment).string()};
  for (const std::string& table : experiment.tables)
    files.insert(fs::weakly_canonical(fs::absolute(table), unused).string());
  for (const std::string& file : known_input_files())
    if (!is_plugin(file) && fs::path(file).extension() != kTypeList && fs::is_regular_file(file, unused))
      files.insert(file);
  return {files.begin(), files.end()};
}

Inputs inputs_of(const Experiment& experiment) {
  Inputs inputs;
  const fs::path own = own_path(experiment);
  for (const std::string& file : known_input_files()) {
    if (file == own || fs::path(file).extension() == kTypeList) continue;
    const std::string name = is_plugin(file)
                                 ? "plugin " + fs::path(file).filename().string()
                                 : "file " + fs::path(file).lexically_relative(own.parent_path()).string();
    if (const auto content = content_hash(file))
      inputs[name] += *content;  // two plugins may have the same name
  }
  for (const World& world : experiment.worlds)
    inputs["world " + world.name] =
        hash_of(world, fs::absolute(experiment.file).lexically_normal().parent_path());
  if (const auto content = content_hash("/proc/self/exe")) inputs["program simbatch"] = *content;
  dl_iterate_phdr(add_own_library, &inputs);
  return inputs;
}

}  // namespace orca::batch
