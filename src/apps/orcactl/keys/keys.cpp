// SPDX-License-Identifier: GPL-3.0-or-later
// Additional permission: LICENSES/Orca-plugin-exception.txt
#include "keys/keys.hpp"

#include <chrono>
#include <cstdio>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "asking.hpp"
#include "keys/permits.hpp"
#include "orca/base/files/key_folder.hpp"
#include "orca/base/files/own_library.hpp"
#include "orca/graph/loader.hpp"
#include "orca/host/catalogue.hpp"
#include "orca/keys/authority.hpp"
#include "orca/plugin/index.hpp"
#include "table.hpp"

namespace orca::orcactl {
namespace {

using namespace std::chrono_literals;

constexpr std::uint64_t kDays = 90;
constexpr auto kClockDifference = 1h;  // by which the clock of another machine may be behind

constexpr const char* kDetails =
    "For a graph with security=\"on\". Makes an authority, and for each machine a folder with a key, a "
    "certificate and permissions for "
    "each of its processes that speaks over DDS: it may write and read the topics of its own edges. Give the "
    "profiles and settings "
    "with which the graph is started. The authority's private key stays in +authority; the folder of each "
    "machine belongs in "
    "~/.config/orca/keys/GRAPH there. --renew makes new keys by the same authority, before the others expire "
    "or after the graph has "
    "changed: copy all folders, then start process by process again. --revoke makes the keys of a process or "
    "machine useless, and "
    "new ones for it: copy all folders.\n"
    "\n"
    "orcactl keys graphs/two_machines.xml --set security=on --out keys --days 30";

std::optional<graph::Graph> read_graph(const apps::Call& call) {
  std::vector<std::string> folders{own_plugin_folder()};
  for (const std::string& folder : call.folders("--plugins")) folders.push_back(folder);
  host::PluginCatalogue catalogue{plugin::PluginIndex(folders)};
  xml::Diagnostics diagnostics;
  graph::LoadOptions options{call.all("--profile"), call.all("--set")};
  options.name = call.text("--name").value_or("");
  auto graph = graph::load_file(call.words.front(), options, catalogue, diagnostics);
  std::fputs(diagnostics.text().c_str(), stderr);
  return graph;
}

// What goes where, for people.
std::string instructions(const graph::Graph& graph, const std::string& folder,
                         const std::vector<keys::Permit>& permits) {
  std::map<std::string, std::string> processes;  // by machine
  for (const keys::Permit& permit : permits) {
    std::string& names = processes[permit.machine];
    names += (names.empty() ? "" : ", ") + permit.process;
  }
  const std::string place = "~/.config/orca/keys/" + as_file_name(graph.name) + "/";
  std::string text = "keys in " + folder + "\n  " + keys::kAuthorityFolder +
                     ": the authority's private key. Keep it apart; no machine needs it to run.\n";
  for (const auto& [machine, names] : processes)
    text += "  " + key_folder_name(machine) + ": for " + names + ". It belongs in " + place +
            key_folder_name(machine) + (machine.empty() ? "" : " of machine " + machine) +
            ", with its modes (cp -a, rsync -a).\n";
  return text;
}

Failure refusal(Error error) { return {std::move(error)}; }

// Revokes what the command names, and says so.
Status revoke(const std::string& folder, const std::string& name, const std::vector<keys::Permit>& permits,
              const keys::Validity& validity) {
  const auto revoked = keys::revoke_keys(folder, name, permits, validity);
  if (!revoked) return revoked.error();
  for (const std::string& whose : *revoked) print("revoked: the keys of " + whose + "\n");
  print("A machine refuses them when it has the new folder, within a second; until then it does not.\n");
  return ok();
}

}  // namespace

apps::Command keys_command() {
  return {.name = "keys",
          .arguments = {{"GRAPH.xml", apps::Names::file}},
          .options = {{"--out", "DIR", "the system's folder of keys; ~/.config/orca/keys/GRAPH if not given"},
                      {"--days", "N", "until they expire; 90 if not given", false, {}, 1, 3650},
                      {"--renew", "", "make new ones by the authority that is there"},
                      {"--revoke", "NAME", "make those of a process or machine useless"},
                      {"--name", "NAME", "of the system, as for the deployer"},
                      {"--profile", "NAME", "as for the deployer", true},
                      {"--set", "NAME=VALUE", "as for the deployer", true},
                      {"--plugins", "FOLDER", "as for the deployer", true}},
          .text = "make the keys of a secured system from its graph; no system needs to run",
          .details = kDetails};
}

ExitCode handle_keys(const apps::Call& call) {
  const std::optional<graph::Graph> graph = read_graph(call);
  if (!graph) return ExitCode::refused;
  const Result<std::string> usual = keys_of_system(graph->name);
  if (!usual && !call.has("--out")) return report(refusal(usual.error()));
  const std::string folder =
      std::filesystem::absolute(call.text("--out").value_or(usual.value_or(""))).lexically_normal().string();
  const std::vector<keys::Permit> permits = permits_of(*graph);
  if (permits.empty())
    return report(
        refusal(fail(Code::failed_precondition,
                     "no process of this graph speaks over DDS, so it needs no keys", call.words.front())));
  const auto now = std::chrono::system_clock::now();
  const keys::Validity validity{now - kClockDifference,
                                now + std::chrono::days(call.count("--days").value_or(kDays))};
  const std::optional<std::string> revoked = call.text("--revoke");
  const Status done = revoked               ? revoke(folder, *revoked, permits, validity)
                      : call.has("--renew") ? keys::renew_keys(folder, permits, validity)
                                            : keys::make_keys(folder, permits, validity);
  if (!done.ok()) return report(refusal(done.error()));
  print(instructions(*graph, folder, permits));
  if (!graph->secured)
    std::fputs("note: the graph does not say security=\"on\", so it does not use them\n", stderr);
  return ExitCode::done;
}

}  // namespace orca::orcactl
