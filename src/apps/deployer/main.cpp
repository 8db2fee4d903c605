// SPDX-License-Identifier: GPL-3.0-or-later
// Additional permission: LICENSES/Orca-plugin-exception.txt
#include <cstdio>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "describe.hpp"
#include "options.hpp"
#include "orca/graph/loader.hpp"
#include "orca/host/last_words.hpp"

namespace {

using orca::ExitCode;
using orca::deployer::Options;

namespace fs = std::filesystem;

int exit_with(ExitCode code) { return static_cast<int>(code); }

int refuse(const std::string& text) {
  std::fprintf(stderr, "%s\n", text.c_str());
  return exit_with(ExitCode::bad_input);
}

// Plugins are found beside the program, then where the graph says; no environment variable.
std::string plugin_folder() {
  return (fs::read_symlink("/proc/self/exe").parent_path().parent_path() / "plugins").string();
}

int describe(const Options& options) {
  const orca::Result<std::string> text = orca::deployer::describe_plugin(options.file);
  if (!text) return refuse("error: " + text.error().text());
  std::fputs(text->c_str(), stdout);
  return exit_with(ExitCode::finished);
}

int with_graph(const Options& options) {
  // First of all, so that a signal at any moment ends the run as it should.
  std::optional<orca::StopSignal> stop;
  if (options.action == Options::Action::run) stop.emplace();
  orca::xml::Diagnostics diagnostics;
  orca::PluginCatalogue catalogue{orca::PluginIndex({plugin_folder()}), options.run.executive.clock};
  const auto graph =
      orca::graph::load_file(options.file, {options.profiles, options.settings}, catalogue, diagnostics);
  std::fputs(diagnostics.text().c_str(), stderr);
  if (!graph || diagnostics.has_errors()) return exit_with(ExitCode::bad_input);
  if (options.action == Options::Action::print) {
    std::fputs(orca::graph::print(*graph).c_str(), stdout);
    return exit_with(ExitCode::finished);
  }
  if (options.action == Options::Action::check) {
    std::fprintf(stderr, "%s: no errors; %zu components, %zu connections\n", options.file.c_str(),
                 graph->components.size(), graph->edges.size());
    return exit_with(ExitCode::finished);
  }
  return exit_with(orca::run_system(*graph, catalogue, options.run, *stop));
}

}  // namespace

int main(int argc, char** argv) {
  const orca::Result<Options> options = orca::deployer::parse_options({argv + 1, argv + argc});
  if (!options) return refuse("error: " + options.error().text());
  orca::log::set_level(options->log_level);
  const orca::LastWords last_words;
  switch (options->action) {
    case Options::Action::help: std::fputs(orca::deployer::help_text(), stdout); return 0;
    case Options::Action::version: std::puts("orca deployer " ORCA_VERSION); return 0;
    case Options::Action::describe: return describe(*options);
    default: return with_graph(*options);
  }
}
