// SPDX-License-Identifier: LGPL-3.0-or-later
#include "writable_places.hpp"

#include <filesystem>
#include <map>
#include <set>
#include <variant>

namespace orca::supervisor {
namespace {

class Places {
 public:
  // The folder of a file. Names are relative to the working folder of the supervisor, which is that of the process as well.
  void add(const std::string& file) {
    if (!file.empty()) folders_.insert(std::filesystem::absolute(file).parent_path().string());
  }

  void add(const graph::Params& values, const std::map<std::string, Contract>& contracts,
           const std::string& name) {
    const auto contract = contracts.find(name);
    if (contract == contracts.end()) return;
    for (const ParamContract& param : contract->second.params) {
      const auto value = values.find(param.name);
      if (!param.file || value == values.end()) continue;
      if (const auto* const one = std::get_if<std::string>(&value->second)) add(*one);
      if (const auto* const all = std::get_if<std::vector<std::string>>(&value->second))
        for (const std::string& each : *all) add(each);
    }
  }

  [[nodiscard]] std::vector<std::string> all() const { return {folders_.begin(), folders_.end()}; }

 private:
  std::set<std::string> folders_;
};

}  // namespace

std::vector<std::string> writable_places(const graph::Graph& graph, const std::string& process,
                                         const SystemFacts& facts, const host::RunOutputs& outputs) {
  Places places;
  for (const graph::ComponentNode& node : graph.components)
    if (node.process == process) places.add(node.params, facts.contracts, node.name);
  for (const graph::HardwareNode& node : graph.hardware)
    if (node.process == process) places.add(node.params, facts.drivers, node.name);
  places.add(outputs.trace_file);
  places.add(outputs.picture.file);
  for (const host::RecordingOptions& recording : outputs.recordings) places.add(recording.file);
  return places.all();
}

}  // namespace orca::supervisor
