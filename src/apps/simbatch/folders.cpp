// SPDX-License-Identifier: GPL-3.0-or-later
// Additional permission: LICENSES/Orca-plugin-exception.txt
#include "folders.hpp"

#include <cstdio>
#include <fstream>

#include "orca/base/files/own_library.hpp"
#include "orca/base/text.hpp"

namespace orca::simbatch {
namespace {

constexpr const char* kResults = "results.sqlite";

}  // namespace

std::filesystem::path results_in(const std::filesystem::path& folder) {
  return std::filesystem::is_regular_file(folder) ? folder : folder / kResults;
}

std::vector<std::string> names_of_report() {
  return {"report.html", "report.md", "provenance.json", "runs.csv",
          "timing.csv",  "laps.csv",  "figures",         "tables"};
}

Status check_free(const std::filesystem::path& folder, const std::vector<std::string>& names) {
  if (std::filesystem::exists(results_in(folder))) return ok();  // what is there is of the batch
  for (const std::string& name : names)
    if (std::filesystem::exists(std::filesystem::symlink_status(folder / name)))
      return fail(
          Code::already_exists,
          "it is there already and would be overwritten, and no " + std::string(kResults) +
              " beside it says that it is of a batch; bring that back, or move what is there away, or take "
              "another folder by --out DIR",
          (folder / name).lexically_normal().string());
  return ok();
}

Error no_results(const std::string& folder) {
  return fail(Code::not_found,
              in_quotes(folder) + " holds no results of a batch: there is no " + kResults + " in it");
}

Result<std::unique_ptr<batch::Store>> open_results(const std::string& folder) {
  const std::filesystem::path file = results_in(folder);
  if (!std::filesystem::exists(file)) return no_results(folder);
  return batch::Store::open(file.string(), {});
}

std::optional<batch::Experiment> experiment_of(const batch::Store& store) {
  xml::Diagnostics unused;
  std::optional<batch::Experiment> experiment = batch::read_experiment(store.origin().file, unused);
  if (!experiment || batch::identity_of(*experiment) != store.identity()) return std::nullopt;
  return experiment;
}

batch::BatchOptions with_plugins(batch::BatchOptions options, const std::vector<std::string>& folders) {
  options.plugin_folders = {own_plugin_folder()};
  options.plugin_folders.insert(options.plugin_folders.end(), folders.begin(), folders.end());
  return options;
}

std::string build_text() {
  std::ifstream file(own_file("build.txt"));
  std::string text;
  return std::getline(file, text) ? text : "a build that says nothing of itself";
}

ExitCode refuse(const Error& error) {
  std::fprintf(stderr, "error: %s\n", error.text().c_str());
  return ExitCode::bad_input;
}

}  // namespace orca::simbatch
